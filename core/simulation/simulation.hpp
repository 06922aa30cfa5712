// SPDX-License-Identifier: BSD-3-Clause
/// A run from the first load step to the last.
#pragma once

#include "core/simulation/model.hpp"
#include "core/simulation/observer.hpp"

#include <span>

namespace cdca {

/// Runs all load steps and shows each to the observers. Returns what summary.json holds. Throws
/// InputError and SolveError after telling the observers that the run has failed. `from`: where an
/// earlier run of the same case was left. Collective.
Summary run_simulation(const CaseSpec& spec, const std::string& version, Communicator& communicator,
                       const Partitioner& partitioner, std::span<Observer* const> observers,
                       const Checkpoint* from = nullptr);

/// Size of a case, without solving it. Collective.
struct CaseMeasure {
  std::int64_t elements = 0;
  std::int64_t nodes = 0;
  std::int64_t unknowns = 0;
  std::int64_t bytes = 0;  ///< memory that a run is expected to need on all ranks together
  int active_tips = 0;
};
CaseMeasure measure_case(const CaseSpec& spec, Communicator& communicator,
                         const Partitioner& partitioner);

}  // namespace cdca
