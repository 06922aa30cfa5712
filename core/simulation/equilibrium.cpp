// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/equilibrium.hpp"

#include "core/base/errors.hpp"
#include "core/base/first_failure.hpp"
#include "core/mechanics/limit_iteration.hpp"
#include "core/simulation/line_search.hpp"
#include "core/solver/multilevel.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

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

namespace {

/// Forces on own cells in one solve, N per metre of thickness.
struct Forces {
  std::vector<double> external;  ///< of the loads
  std::vector<double> faces;     ///< of given tractions between touching faces
  std::vector<double> held;      ///< prescribed displacements, m
};

/// One linear solve with the springs and the given tractions of the touching faces as they are, to
/// a part of the tolerance.
SolverReport solve_once(Model& model, const EquilibriumSolver& solver, double load_factor,
                        const Forces& given, double part = 1.0) {
  const CellStiffness& cells = model.stiffness();
  const auto own = std::size_t(cells.owned());
  std::vector<double> forces(std::size_t(cells.count()), 0.0), product(forces);
  cells.apply(given.held, product);
  for (std::size_t k = 0; k < own; ++k) forces[k] = given.external[k] + given.faces[k] - product[k];
  // weak springs of loose bodies stand where the bodies are
  std::vector<double>& state = model.state();
  cells.add_spring_forces(state, forces);
  cells.clear_held(forces);
  cells.clear_held(state);
  SolverReport report;
  const double scale = std::sqrt(cells.dot(forces, forces));
  if (scale > 0.0) {
    report = solver.solve(cells, forces, state, part * scale);
    require_convergence(report, model.spec().solver, load_factor);
    report.scale = scale;
  } else {
    std::fill(state.begin(), state.end(), 0.0);
  }
  for (std::size_t k = 0; k < own; ++k) state[k] += given.held[k];
  cells.halo().copy_state(state);
  return report;
}

void set_held(const Model& model, const std::vector<double>& held, std::vector<double>& state) {
  model.stiffness().clear_held(state);
  for (std::size_t k = 0; k < held.size(); ++k) state[k] += held[k];
  model.stiffness().halo().copy_state(state);
}

/// Of the forces that weak springs have added in a solve, as a part of all forces: bodies may not
/// have gone far enough yet.
double held_back(const Model& model, const LineSearch& search, double scale) {
  if (!model.has_weak_springs() || scale == 0.0) return 0.0;
  const CellStiffness& cells = model.stiffness();
  std::vector<double> weak(std::size_t(cells.count()), 0.0);
  cells.add_spring_forces(search.move(), weak);
  return std::sqrt(cells.dot(weak, weak)) / scale;
}

/// What friction is to count with after one more solve. At first limits follow at once; then they
/// wait until the states of all faces have settled for them.
std::vector<double> next_limits(LimitIteration& friction, const ContactPatches& contact,
                                const std::vector<ContactGap>& gaps, bool settled, int iteration) {
  constexpr int follow_at_once = 20;
  const auto found = contact.limits_at(gaps);
  if (settled) return friction.next(contact.limits(), found, iteration < follow_at_once ? 1 : 0.5);
  if (iteration >= follow_at_once) return contact.limits();
  friction.restart();
  return found;
}

/// Steps 5-7 of 2.4.3: solves until the tractions that faces answer with are those that the last
/// solve counted with.
SolverReport settle_contact(Model& model, const EquilibriumSolver& solver, double load_factor,
                            Forces& given, Equilibrium& result) {
  constexpr int most = 500;
  constexpr double firmest = 1e-3, weakest = 1e-6;  // springs of loose bodies
  constexpr double farthest = 1024;                 // that these bodies go, in moves
  // weak springs must not turn small errors into long ways
  const double tolerance = model.spec().solver.tolerance, enough = 10 * tolerance;
  const double part = model.has_weak_springs() ? std::clamp(1e-13 / tolerance, 1e-2, 1.0) : 1.0;
  ContactPatches& contact = model.contact();
  SolverReport worst;
  worst.converged = true;
  set_held(model, given.held, model.state());
  // new faces answer to where they are, so that the first move goes towards balance
  const auto here = model.contact_spots().gaps(model.state(), contact, model.communicator());
  if (contact.respond(here, contact.limits_at(here)).springs) model.build_stiffness(firmest);
  LimitIteration friction;
  double weak = firmest;
  for (int& k = result.contact_iterations = 1; k <= most; ++k) {
    std::fill(given.faces.begin(), given.faces.end(), 0.0);
    model.add_contact_forces(given.faces);
    const std::vector<double> from = model.state();
    const SolverReport report = solve_once(model, solver, load_factor, given, part);
    worst.iterations = std::max(worst.iterations, report.iterations);
    worst.residual = report.residual;
    const LineSearch search(model, given.external, from);
    const double pulled = held_back(model, search, report.scale);
    const double share = search.find(pulled > enough ? farthest : 1.0);
    search.go(share, from, model.state());
    const auto gaps = search.gaps(share);
    const bool whole = share >= 1.0, settled = whole && contact.settled(gaps);
    const auto change = contact.respond(gaps, next_limits(friction, contact, gaps, settled, k));
    // bodies that only others hold are let go little by little
    const double before = std::exchange(weak, whole ? std::max(weakest, 0.3 * weak) : weak);
    if (change.springs || (weak != before && model.has_weak_springs())) model.build_stiffness(weak);
    result.contact_unbalanced = change.largest > 0.0 ? change.unbalanced / change.largest : 0.0;
    if (share == 1.0 && change.unbalanced <= enough * change.largest && pulled <= enough)
      return worst;
  }
  std::ostringstream text;
  text << "the contact of crack faces at load factor " << load_factor << " did not settle in "
       << most << " iterations; smaller load steps may help.";
  throw ContactError(text.str());
}

}  // namespace

Equilibrium find_equilibrium(Model& model, const EquilibriumSolver& solver, double load_factor) {
  const auto all = std::size_t(model.stiffness().count());
  Forces given{std::vector<double>(all, 0.0), std::vector<double>(all, 0.0),
               std::vector<double>(all, 0.0)};
  fail_together(model.communicator(), [&] {
    // an expression may have no value at some place of one rank
    add_external_forces(model.basis(), model.loads(load_factor), given.external);
    model.supports().prescribe(model.spec().boundaries, load_factor, given.held);
  });
  Equilibrium result;
  result.solver = model.contact().empty()
                      ? solve_once(model, solver, load_factor, given)
                      : settle_contact(model, solver, load_factor, given, result);

  const CellStiffness& cells = model.stiffness();
  std::vector<double> product(all, 0.0);
  cells.apply(model.state(), product);
  std::vector<double> weak(all, 0.0);
  cells.add_spring_forces(model.state(), weak);
  for (std::size_t k = 0; k < all; ++k) product[k] -= weak[k];
  result.strain_energy = 0.5 * cells.dot(model.state(), product) + model.contact_energy();
  std::vector<double> sums(2 * model.spec().boundaries.size(), 0.0);
  result.supports.assign(all, 0.0);
  for (const HeldUnknown& h : model.supports().held()) {
    const auto u = std::size_t(h.unknown);
    result.supports[u] = product[u] - given.external[u] - given.faces[u];
    // of a shifted near-tip function only the pieces' unknowns carry a resultant
    if (!h.samples.empty()) sums[2 * h.block + std::size_t(h.component)] += result.supports[u];
  }
  cells.communicator().sum(std::span<double>(sums));
  for (std::size_t b = 0; 2 * b < sums.size(); ++b)
    result.reactions.emplace_back(sums[2 * b], sums[2 * b + 1]);
  result.external = std::move(given.external);
  return result;
}

}  // namespace cdca
