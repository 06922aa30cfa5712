// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/linear_solve.hpp"

#include "core/base/errors.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace cdca {

namespace {

void require_convergence(const SolverReport& report, const SolverSpec& spec, double load_factor) {
  // one that is as exact as the case asks for has not failed, though more may have been wanted
  if (report.converged || report.residual <= spec.tolerance) return;
  std::ostringstream text;
  text << "equilibrium at load factor " << load_factor << " was not reached: after "
       << report.iterations << " iterations the relative residual is " << report.residual
       << ", above solver.tolerance = " << spec.tolerance << ".";
  throw SolveError(text.str());
}

double norm(const CellSystem& cells, const std::vector<double>& forces) {
  return std::sqrt(cells.dot(forces, forces));
}

}  // namespace

SolverReport solve_once(Model& model, const EquilibriumSolver& solver, double load_factor,
                        const Forces& given, const Accuracy& accuracy) {
  const CellStiffness& cells = model.stiffness();
  const SolverSpec& spec = model.spec().solver;
  const auto own = std::size_t(cells.owned());
  std::vector<double> forces(std::size_t(cells.count()), 0.0);
  for (std::size_t k = 0; k < own; ++k) forces[k] = given.external[k] + given.faces[k];
  cells.subtract_held(given.held, forces);
  cells.clear_held(forces);
  const double without_springs = norm(cells, forces);
  // weak springs of loose bodies stand where the bodies are, or where they are to be held
  std::vector<double>& state = model.state();
  cells.add_spring_forces(given.anchor.empty() ? state : given.anchor, forces);
  cells.clear_held(forces);
  cells.clear_held(state);
  SolverReport report;
  report.scale = norm(cells, forces);
  if (given.drags && without_springs > 0.0) report.scale = without_springs;
  if (report.scale > 0.0) {
    const double scale = report.scale;
    report = solver.solve(cells, forces, state, scale, accuracy);
    require_convergence(report, spec, load_factor);
    report.scale = scale;
  } else {
    std::fill(state.begin(), state.end(), 0.0);
  }
  for (std::size_t k = 0; k < own; ++k) state[k] += given.held[k];
  cells.halo().copy_state(state);
  return report;
}

std::vector<double> inner_forces(const Model& model) {
  const CellStiffness& cells = model.stiffness();
  std::vector<double> forces(std::size_t(cells.count()), 0.0);
  cells.apply(model.state(), forces);
  cells.add_spring_forces(model.state(), forces, -1.0);
  return forces;
}

std::vector<double> support_forces(const Model& model, const Forces& given,
                                   const std::vector<double>& inner) {
  std::vector<double> forces(inner.size(), 0.0);
  for (const HeldUnknown& h : model.supports().held()) {
    const auto u = std::size_t(h.unknown);
    forces[u] = inner[u] - given.external[u] - given.faces[u];
  }
  return forces;
}

}  // namespace cdca
