// SPDX-License-Identifier: BSD-3-Clause
/// One linear solve of a model with the springs and tractions of its faces as they are.
#pragma once

#include "core/simulation/model.hpp"
#include "core/solver/equilibrium_solver.hpp"

#include <vector>

namespace cdca {

/// On own cells, in one solve.
struct Forces {
  std::vector<double> external;  ///< of the loads, N per metre of thickness
  std::vector<double> faces;     ///< of given tractions between touching faces, likewise
  std::vector<double> held;      ///< prescribed displacements, m
  /// State in which weak springs pull with nothing; the model's, if empty.
  std::vector<double> anchor = {};
  /// Weak springs are drag: other forces alone say how exact solves are.
  bool drags = false;
};

/// Moves the model's state to where these forces are in balance, ghosts included. The report's
/// residual and scale are relative to all forces. Throws SolveError when the solver does not
/// converge. Collective.
SolverReport solve_once(Model& model, const EquilibriumSolver& solver, double load_factor,
                        const Forces& given, const Accuracy& accuracy = {});

/// K u of the model's state, without weak springs, N per metre of thickness. Collective.
std::vector<double> inner_forces(const Model& model);
/// Nodal forces of the supports on own cells, 0 where nothing is held. inner: as of inner_forces().
std::vector<double> support_forces(const Model& model, const Forces& given,
                                   const std::vector<double>& inner);

}  // namespace cdca
