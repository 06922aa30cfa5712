// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/equilibrium.hpp"

#include "core/base/errors.hpp"
#include "core/base/first_failure.hpp"
#include "core/solver/multilevel.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace cdca {

std::unique_ptr<EquilibriumSolver> make_solver(const Model& model) {
  const SolverSpec& spec = model.spec().solver;
  const SolverOptions options{spec.tolerance, spec.over_relaxation, spec.max_iterations};
  if (spec.method == SolverMethod::relaxation) return make_relaxation(options);
  if (spec.method == SolverMethod::krylov) return make_krylov(options);
  return make_multilevel(options, model.hierarchy());
}

namespace {

void require_convergence(const SolverReport& report, const SolverSpec& spec, double load_factor) {
  if (report.converged) return;
  std::ostringstream text;
  text << "equilibrium at load factor " << load_factor << " was not reached: after "
       << report.iterations << " iterations the relative residual is " << report.residual
       << ", above solver.tolerance = " << spec.tolerance << ".";
  throw SolveError(text.str());
}

}  // namespace

Equilibrium unloaded(Model& model) {
  std::fill(model.state().begin(), model.state().end(), 0.0);
  Equilibrium result;
  result.reactions.assign(model.spec().boundaries.size(), Vec2(0, 0));
  result.external.assign(model.state().size(), 0.0);
  result.supports.assign(model.state().size(), 0.0);
  return result;
}

Equilibrium find_equilibrium(Model& model, const EquilibriumSolver& solver, double load_factor) {
  const CellStiffness& cells = model.stiffness();
  const auto all = std::size_t(cells.count());
  const auto own = std::size_t(cells.owned());
  std::vector<double> external(all, 0.0), held(all, 0.0), product(all, 0.0), forces(all, 0.0);
  fail_together(cells.communicator(), [&] {
    // an expression may have no value at some place of one rank
    add_external_forces(model.basis(), model.loads(load_factor), external);
    model.supports().prescribe(model.spec().boundaries, load_factor, held);
  });
  cells.apply(held, product);
  for (std::size_t k = 0; k < own; ++k) forces[k] = external[k] - product[k];
  cells.clear_held(forces);

  Equilibrium result;
  std::vector<double>& state = model.state();
  cells.clear_held(state);
  const double scale = std::sqrt(cells.dot(forces, forces));
  if (scale > 0.0) {
    result.solver = solver.solve(cells, forces, state, scale);
    require_convergence(result.solver, model.spec().solver, load_factor);
  } else {
    std::fill(state.begin(), state.end(), 0.0);
  }
  for (std::size_t k = 0; k < own; ++k) state[k] += held[k];
  cells.halo().copy_state(state);

  cells.apply(state, product);
  result.strain_energy = 0.5 * cells.dot(state, product);
  std::vector<double> sums(2 * model.spec().boundaries.size(), 0.0);
  result.supports.assign(all, 0.0);
  for (const HeldUnknown& h : model.supports().held()) {
    const auto u = std::size_t(h.unknown);
    result.supports[u] = product[u] - external[u];
    // of a shifted near-tip function only the pieces' unknowns carry a resultant
    if (!h.samples.empty())
      sums[2 * h.block + std::size_t(h.component)] += product[u] - external[u];
  }
  cells.communicator().sum(std::span<double>(sums));
  for (std::size_t b = 0; 2 * b < sums.size(); ++b)
    result.reactions.emplace_back(sums[2 * b], sums[2 * b + 1]);
  result.external = std::move(external);
  return result;
}

}  // namespace cdca
