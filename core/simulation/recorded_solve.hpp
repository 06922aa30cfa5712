// SPDX-License-Identifier: BSD-3-Clause
/// Equilibria on the way of a run, with what its story tells of them.
#pragma once

#include "core/simulation/recorder.hpp"

namespace cdca {

/// find_equilibrium(), noted in the story with the time that it took.
Equilibrium solve_recorded(Model& model, const EquilibriumSolver& solver, double load_factor,
                           Recorder& recorder, FaceMotion faces = FaceMotion::creeping);

/// What faces have slipped and where they are open becomes history, its friction work is booked.
void accept_contact(Model& model, Model::Since since, EnergyLedger& energy);

}  // namespace cdca
