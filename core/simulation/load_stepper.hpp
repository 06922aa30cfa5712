// SPDX-License-Identifier: BSD-3-Clause
/// The main loop: load steps, and growth cycles within them.
#pragma once

#include "core/simulation/recorder.hpp"

namespace cdca {

/// Where a run begins, or goes on.
struct RunStart {
  Progress progress;
  EnergyLedger energy;
};

/// Load steps as given: at each, equilibrium and growth in turn until no tip grows.
void run_prescribed(Model& model, Recorder& recorder, RunStart start);

/// The load factor at which the next tip grows, again and again; follows snap-back. Loads must be
/// proportional to the factor. One step is recorded per growth event.
void run_critical(Model& model, Recorder& recorder, RunStart start);

}  // namespace cdca
