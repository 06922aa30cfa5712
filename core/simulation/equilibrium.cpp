// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/equilibrium.hpp"

#include "core/base/first_failure.hpp"
#include "core/simulation/contact_iteration.hpp"
#include "core/simulation/linear_solve.hpp"
#include "core/solver/multilevel.hpp"

#include <algorithm>
#include <utility>

namespace cdca {

std::unique_ptr<EquilibriumSolver> make_solver(const Model& model) {
  const SolverSpec& spec = model.spec().solver;
  const SolverOptions options{spec.tolerance, spec.over_relaxation, spec.max_iterations};
  if (spec.method == SolverMethod::relaxation) return make_relaxation(options);
  if (spec.method == SolverMethod::krylov) return make_krylov(options);
  return make_multilevel(options, model.hierarchy());
}

Equilibrium unloaded(Model& model) {
  std::fill(model.state().begin(), model.state().end(), 0.0);
  Equilibrium result;
  result.reactions.assign(model.spec().boundaries.size(), Vec2(0, 0));
  result.external.assign(model.state().size(), 0.0);
  result.supports.assign(model.state().size(), 0.0);
  return result;
}

Equilibrium find_equilibrium(Model& model, const EquilibriumSolver& solver, double load_factor,
                             FaceMotion faces) {
  const auto all = std::size_t(model.stiffness().count());
  Forces given{std::vector<double>(all, 0.0), std::vector<double>(all, 0.0),
               std::vector<double>(all, 0.0)};
  fail_together(model.communicator(), [&] {
    // an expression may have no value at some place of one rank
    add_external_forces(model.basis(), model.loads(load_factor), given.external);
    model.supports().prescribe(model.spec().boundaries, load_factor, given.held);
  });
  Equilibrium result;
  if (model.contact().empty() || faces == FaceMotion::none) {
    model.add_contact_forces(given.faces);
    result.solver = solve_once(model, solver, load_factor, given);
  } else {
    result.solver = settle_contact(model, solver, load_factor, faces, given, result);
  }

  const CellStiffness& cells = model.stiffness();
  const std::vector<double> inner = inner_forces(model);
  result.strain_energy = 0.5 * cells.dot(model.state(), inner) + model.contact_energy();
  result.supports = support_forces(model, given, inner);
  std::vector<double> sums(2 * model.spec().boundaries.size(), 0.0);
  for (const HeldUnknown& h : model.supports().held()) {
    // of a shifted near-tip function only the pieces' unknowns carry a resultant
    if (!h.samples.empty())
      sums[2 * h.block + std::size_t(h.component)] += result.supports[std::size_t(h.unknown)];
  }
  cells.communicator().sum(std::span<double>(sums));
  for (std::size_t b = 0; 2 * b < sums.size(); ++b)
    result.reactions.emplace_back(sums[2 * b], sums[2 * b + 1]);
  result.external = std::move(given.external);
  return result;
}

}  // namespace cdca
