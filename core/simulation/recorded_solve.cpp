// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/recorded_solve.hpp"

namespace cdca {

Equilibrium solve_recorded(Model& model, const EquilibriumSolver& solver, double load_factor,
                           Recorder& recorder, FaceMotion faces) {
  const Stopwatch watch;
  Equilibrium equilibrium = find_equilibrium(model, solver, load_factor, faces);
  recorder.solved(equilibrium, watch.seconds());
  return equilibrium;
}

void accept_contact(Model& model, Model::Since since, EnergyLedger& energy) {
  energy.add_friction(model.accept_contact(since));
}

}  // namespace cdca
