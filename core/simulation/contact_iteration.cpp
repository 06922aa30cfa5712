// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/contact_iteration.hpp"

#include "core/base/errors.hpp"
#include "core/mechanics/face_barrier.hpp"
#include "core/simulation/contact_solves.hpp"
#include "core/simulation/line_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace cdca {

namespace {

/// Limits of friction follow the pressures in so many iterations, then only where states settle.
constexpr int follow_at_once = 20;
/// Moves shorter than this turn faces one by one; after a few of them all faces are brought into
/// balance at once.
constexpr double short_move = 0.1;
constexpr int short_moves = 4;

void set_held(const Model& model, const std::vector<double>& held, std::vector<double>& state) {
  model.stiffness().clear_held(state);
  for (std::size_t k = 0; k < held.size(); ++k) state[k] += held[k];
  model.stiffness().halo().copy_state(state);
}

/// How well tractions can be balanced after a solve, as a part of the largest: `enough` where it
/// was as exact as `wanted`, or worse in the measure in which rounding has kept it from that, and
/// no better than `rounding` lets gaps be told; less than nothing where it was not exact.
double balance_after(const SolverReport& solve, double wanted, double enough, double rounding) {
  if (solve.residual <= wanted) return std::max(enough, rounding);
  const double allowed = std::max(rounding, enough * solve.residual / wanted);
  return solve.rounded && allowed <= ContactSolves::worst_balance ? allowed : -1.0;
}

SolverReport settle(Model& model, const EquilibriumSolver& solver, double load_factor,
                    Forces& given, Equilibrium& result) {
  constexpr int most = 500;
  constexpr double firmest = 1e-3, weakest = 1e-6;  // springs of loose bodies
  constexpr double farthest = 1024;                 // that these bodies go, in moves
  constexpr double nearly = 1e-2;                   // unbalanced tractions where few faces turn
  constexpr double tiny = std::numeric_limits<double>::min();
  // weak springs must not turn small errors into long ways
  const double tolerance = model.spec().solver.tolerance, enough = 10 * tolerance;
  const double part = model.has_weak_springs() ? std::clamp(1e-13 / tolerance, 1e-2, 1.0) : 1.0;
  ContactPatches& contact = model.contact();
  ContactSolves solves(model, solver, load_factor, given);
  set_held(model, given.held, model.state());
  // new faces answer to where they are, so that the first move goes towards balance
  const auto here = solves.gaps();
  if (contact.respond(here, contact.limits_at(here)).springs) solves.turn_springs(firmest);
  double weak = firmest, unbalanced = 1.0;
  bool settled = false, begin_anew = false;
  int cut_short = 0;
  for (int& k = result.contact_iterations = 1; k <= most; ++k) {
    // while many faces still change their states it is of no use to be exact
    const bool near = settled || unbalanced <= nearly;
    // rounding can keep a face that is about to turn from settling for ever
    const bool following = k <= follow_at_once || (near && solves.slowest().rounded);
    const double agreed = near ? 0.1 * enough : 0.1 * std::min(1.0, 10 * unbalanced) * unbalanced;
    const std::vector<double> from = model.state();
    solves.once({part, following && !near ? 1e-3 : 0.0});
    if (following || settled) solves.turn_limits(std::max(agreed, 0.1 * enough), part);
    const LineSearch search(model, given.external, from);
    const double pulled = solves.held_back(search.move());
    const double share = search.find(pulled > enough ? farthest : 1.0);
    search.go(share, from, model.state());
    const auto gaps = search.gaps(share);
    const bool whole = share >= 1.0;
    settled = whole && contact.settled(gaps);
    const auto limits = following || settled ? contact.limits_at(gaps) : contact.limits();
    const auto change = contact.respond(gaps, limits);
    // bodies that only others hold are let go little by little
    const double before = std::exchange(weak, whole ? std::max(weakest, 0.3 * weak) : weak);
    if (change.springs || (weak != before && model.has_weak_springs())) solves.turn_springs(weak);
    unbalanced = change.unbalanced / std::max({change.largest, change.unbalanced, tiny});
    result.contact_unbalanced = unbalanced;
    result.linear_solves = solves.count();
    // rounding keeps solves from being exact when loose bodies have gone far
    const double balanced =
        balance_after(solves.slowest(), part * tolerance, enough, solves.rounding(change.largest));
    if (share == 1.0 && unbalanced <= balanced && pulled <= enough) return solves.slowest();
    cut_short += share < short_move;
    const bool jammed = cut_short == short_moves || k == follow_at_once;
    if (jammed && FaceBarrier::suits(contact)) {
      const Model::ContactMemory memory = model.contact_memory();
      const std::vector<double> state = model.state();
      const auto balance = solves.balance_faces(enough, begin_anew ? 0.0 : nearly);
      begin_anew = true;
      k += balance.steps;
      result.contact_unbalanced = balance.unbalanced;
      result.linear_solves = solves.count();
      if (balance.found) return solves.slowest();
      if (balance.unbalanced > nearly) {
        model.remember(memory);
        model.state() = state;
      }
      solves.build_stiffness(weak);
      unbalanced = nearly;
      cut_short = 0;
    }
  }
  std::ostringstream text;
  text << "the contact of crack faces at load factor " << load_factor << " did not settle in "
       << most << " iterations; smaller load steps may help.";
  throw ContactError(text.str());
}

}  // namespace

SolverReport settle_contact(Model& model, const EquilibriumSolver& solver, double load_factor,
                            Forces& given, Equilibrium& result) {
  try {
    return settle(model, solver, load_factor, given, result);
  } catch (const ContactError&) {
    throw;
  } catch (const SolveError& error) {
    // springs of faces may stand in such proportions that no solve is exact
    throw ContactError(std::string("the contact of crack faces did not settle: ") + error.what());
  }
}

}  // namespace cdca
