// SPDX-License-Identifier: BSD-3-Clause
/// Equilibrium of a model under the loads of one load factor.
#pragma once

#include "core/simulation/model.hpp"
#include "core/solver/equilibrium_solver.hpp"

#include <optional>

namespace cdca {

std::unique_ptr<EquilibriumSolver> make_solver(const Model& model);

struct Equilibrium {
  SolverReport solver;  ///< of the slowest linear solve
  /// How often touching faces changed until they settled, all turns on the condensed body in a row
  /// being one; 0: none touch.
  int contact_iterations = 0;
  int linear_solves = 1;  ///< in all turns
  /// Largest traction of a face that the last solve did not count with, over the largest traction.
  double contact_unbalanced = 0.0;
  /// Force of the supports of every boundary block on the body, N per metre of thickness.
  std::vector<Vec2> reactions;
  double strain_energy = 0.0;  ///< J per metre of thickness
  std::vector<double>
      external;  ///< nodal forces of the loads on own cells, N per metre of thickness
  std::vector<double>
      supports;  ///< nodal forces of the supports, likewise; 0 where nothing is held
  /// Where bodies have crept here: the equilibrium that they have crept from. There the loads were
  /// what they are here, and faces that touched stuck.
  struct BeforeCreep {
    std::vector<double> state, supports;
  };
  std::optional<BeforeCreep> before_creep;
};

/// A body that has come apart carries nothing: no displacement, no force.
Equilibrium unloaded(Model& model);

/// What touching faces may do on the way to an equilibrium.
enum class FaceMotion {
  none,      ///< springs and tractions stay what they are
  balanced,  ///< turn until they are in balance
  creeping   ///< and where that is not found nearby, bodies creep there (creep.hpp)
};

/// Starts from the model's state and leaves the new one there, ghosts included. Throws SolveError
/// when the solver does not converge, ContactError when faces do not settle. Collective.
Equilibrium find_equilibrium(Model& model, const EquilibriumSolver& solver, double load_factor,
                             FaceMotion faces = FaceMotion::creeping);

}  // namespace cdca
