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

namespace {

/// Forces on own cells in one solve, N per metre of thickness.
struct Forces {
  std::vector<double> external;  ///< of the loads
  std::vector<double> faces;     ///< of given tractions between touching faces
  std::vector<double> held;      ///< prescribed displacements, m
};

/// One linear solve with the springs and the given tractions of the touching faces as they are.
SolverReport solve_once(Model& model, const EquilibriumSolver& solver, double load_factor,
                        const Forces& given) {
  const CellStiffness& cells = model.stiffness();
  const auto own = std::size_t(cells.owned());
  std::vector<double> forces(std::size_t(cells.count()), 0.0), product(forces);
  cells.apply(given.held, product);
  for (std::size_t k = 0; k < own; ++k) forces[k] = given.external[k] + given.faces[k] - product[k];
  cells.clear_held(forces);
  std::vector<double>& state = model.state();
  cells.clear_held(state);
  SolverReport report;
  const double scale = std::sqrt(cells.dot(forces, forces));
  if (scale > 0.0) {
    report = solver.solve(cells, forces, state, scale);
    require_convergence(report, model.spec().solver, load_factor);
  } else {
    std::fill(state.begin(), state.end(), 0.0);
  }
  for (std::size_t k = 0; k < own; ++k) state[k] += given.held[k];
  cells.halo().copy_state(state);
  return report;
}

/// How far to go from one state towards the next, which was found with springs that may be the
/// wrong ones: to where the forces on the way are in balance, so that faces cannot be thrown open
/// and shut for ever.
class LineSearch {
 public:
  LineSearch(const Model& model, const std::vector<double>& external,
             const std::vector<double>& from)
      : model_(model), move_(model.state()) {
    for (std::size_t k = 0; k < move_.size(); ++k) move_[k] -= from[k];
    const CellStiffness& cells = model.stiffness();
    std::vector<double> product(move_.size(), 0.0);
    cells.apply(from, product);
    for (std::size_t k = 0; k < product.size(); ++k) product[k] = external[k] - product[k];
    driving_ = cells.dot(product, move_);
    cells.apply(move_, product);
    stiffness_ = cells.dot(product, move_);
    at_ = model.contact_spots().fields(from);
    moves_ = model.contact_spots().fields(move_);
    gaps_ = gaps_of(from);
    gaps_there_ = gaps_of(model.state());
    // the rest of the body, without the faces
    const auto& spots = model.contact_spots();
    driving_ += model.communicator().sum(spots.spring_work(model.contact(), at_, moves_));
    stiffness_ -= model.communicator().sum(spots.spring_work(model.contact(), moves_, moves_));
  }

  /// Share of the move, from 0 to 1.
  double find() const {
    const double start = work(0.0), end = work(1.0);
    if (!(start > 0.0) || end >= -accepted * start) return 1.0;
    double low = 0.0, high = 1.0, at_low = start, at_high = end;
    for (int k = 0; k < 20; ++k) {
      const double share = low + (high - low) * std::clamp(at_low / (at_low - at_high), 0.1, 0.9);
      const double now = work(share);
      if (std::abs(now) <= 0.1 * start) return share;
      (now > 0.0 ? low : high) = share;
      (now > 0.0 ? at_low : at_high) = now;
    }
    return high;
  }

  const std::vector<double>& move() const { return move_; }
  std::vector<ContactGap> gaps(double share) const {
    std::vector<ContactGap> found;
    for (std::size_t p = 0; p < gaps_.size(); ++p) {
      const auto between = [share](double a, double b) { return a + share * (b - a); };
      found.push_back({between(gaps_[p].normal, gaps_there_[p].normal),
                       between(gaps_[p].tangential, gaps_there_[p].tangential)});
    }
    return found;
  }

 private:
  static constexpr double accepted = 0.5;  ///< overshoot, of the work at the start

  std::vector<ContactGap> gaps_of(const std::vector<double>& state) const {
    return model_.contact_spots().gaps(state, model_.contact(), model_.communicator());
  }
  /// Of all forces on the move, where this share of it is done.
  double work(double share) const {
    const auto answers = model_.contact().answers_to(gaps(share));
    return driving_ - share * stiffness_ -
           model_.communicator().sum(
               model_.contact_spots().work(model_.contact(), answers, at_, moves_, share));
  }

  const Model& model_;
  std::vector<double> move_;
  double driving_ = 0.0;    ///< work of loads and body on the move, at its start
  double stiffness_ = 0.0;  ///< of the body along the move
  ContactSpots::Fields at_, moves_;
  std::vector<ContactGap> gaps_, gaps_there_;
};

void set_held(const Model& model, const std::vector<double>& held, std::vector<double>& state) {
  model.stiffness().clear_held(state);
  for (std::size_t k = 0; k < held.size(); ++k) state[k] += held[k];
  model.stiffness().halo().copy_state(state);
}

/// Steps 5-7 of 2.4.3: solves until no patch changes its state and the tractions settle.
SolverReport settle_contact(Model& model, const EquilibriumSolver& solver, double load_factor,
                            Forces& given, Equilibrium& result) {
  constexpr int most = 60;
  SolverReport worst;
  set_held(model, given.held, model.state());
  for (result.contact_iterations = 1; result.contact_iterations <= most;
       ++result.contact_iterations) {
    std::fill(given.faces.begin(), given.faces.end(), 0.0);
    model.add_contact_forces(given.faces);
    const std::vector<double> from = model.state();
    const SolverReport report = solve_once(model, solver, load_factor, given);
    worst.iterations = std::max(worst.iterations, report.iterations);
    worst.residual = report.residual;
    worst.converged = true;
    const LineSearch search(model, given.external, from);
    const double share = search.find();
    if (share < 1.0) {
      for (std::size_t k = 0; k < from.size(); ++k)
        model.state()[k] = from[k] + share * search.move()[k];
    }
    const ContactPatches::Change change = model.contact().respond(search.gaps(share));
    const double tolerance = 10 * model.spec().solver.tolerance;
    if (share == 1.0 && !change.springs && change.traction <= tolerance * change.largest)
      return worst;
    if (change.springs) model.build_stiffness();
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
