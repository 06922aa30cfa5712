// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/face_turns.hpp"

#include "core/mechanics/face_barrier.hpp"
#include "core/simulation/line_search.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cdca {

namespace {

/// Limits of friction follow the pressures in so many iterations, then only where states settle.
constexpr int follow_at_once = 20;
/// Moves shorter than this turn faces one by one.
constexpr double short_move = 0.1;
constexpr double firmest = 1e-3, weakest = 1e-6;  ///< springs of loose bodies
constexpr double farthest = 1024;                 ///< that these bodies go, in moves

/// How well tractions can be balanced after a solve, as a part of the largest: `enough` where it
/// was as exact as `wanted`, or worse in the measure in which rounding has kept it from that, and
/// no better than `rounding` lets gaps be told; less than nothing where it was not exact.
double balance_after(const SolverReport& solve, double wanted, double enough, double rounding) {
  if (solve.residual <= wanted) return std::max(enough, rounding);
  const double allowed = std::max(rounding, enough * solve.residual / wanted);
  return solve.rounded && allowed <= ContactSolves::worst_balance ? allowed : -1.0;
}

/// Where the body is condensed to its faces, these are settled on it first.
FaceTurns::Patience patience_of(const Model& model, bool drags) {
  constexpr int forever = std::numeric_limits<int>::max();
  if (model.condenses() && FaceBarrier::suits(model.contact())) return {0, 0};
  return drags ? FaceTurns::Patience{forever, forever} : FaceTurns::Patience{4, follow_at_once};
}

}  // namespace

FaceTurns::FaceTurns(Model& model, ContactSolves& solves, Forces& given, const Rule& rule)
    : model_(model),
      solves_(solves),
      given_(given),
      rule_(rule),
      patience_(patience_of(model, drags())),
      weak_(drags() ? rule.drag : firmest) {
  // weak springs must not turn small errors into long ways
  if (model.has_weak_springs())
    part_ = std::clamp(1e-13 / model.spec().solver.tolerance, 1e-2, 1.0);
  given.drags = drags();
  if (drags()) given.anchor = model.state();
  // new faces answer to where they are, so that the first move goes towards balance
  const auto here = solves.gaps();
  auto limits = model.contact().limits_at(here);
  if (rule.ahead != 1.0) {
    const auto before = model.contact().limits();
    for (std::size_t p = 0; p < limits.size(); ++p)
      limits[p] = std::max(0.0, before[p] + rule.ahead * (limits[p] - before[p]));
  }
  const bool turned = model.contact().respond(here, limits).springs;
  // weak springs have the same beginning in a run that goes on
  if ((turned || drags() || model.has_weak_springs()) && patience_.turns > 0)
    model.renew_stiffness(weak_);
}

FaceTurns::End FaceTurns::turn() {
  if (patience_.turns == 0) return End::jammed;
  while (count_ < rule_.most) {
    if (once()) {
      solves_.set_forces_of_faces();  // those of the springs as they are now
      return End::balanced;
    }
    if (cut_short_ >= patience_.short_moves || count_ == patience_.turns) return End::jammed;
  }
  return End::too_many;
}

void FaceTurns::begin_again() {
  constexpr int a_few = 6;
  if (model_.condenses()) patience_ = {1, count_ + a_few};
  model_.renew_stiffness(weak_);
  unbalanced_ = nearly;
  cut_short_ = 0;
}

void FaceTurns::take(double unbalanced) {
  const auto change = model_.contact().respond(solves_.gaps(), model_.contact().limits());
  unbalanced_ = unbalanced;
  limits_off_ = change.largest > 0.0 ? change.unbalanced / change.largest : 0.0;
  pulled_ = solves_.held_back(from_anchor());
  balanced_to_ = std::max(rule_.enough, solves_.rounding(change.largest));
}

bool FaceTurns::once() {
  ContactPatches& contact = model_.contact();
  const double tolerance = model_.spec().solver.tolerance, enough = rule_.enough;
  ++count_;
  // while many faces still change their states it is of no use to be exact
  const bool near = settled_ || unbalanced_ <= nearly;
  // rounding can keep a face that is about to turn from settling for ever
  const bool at_once = count_ <= follow_at_once || (near && solves_.slowest().rounded);
  const auto limits_follow = [&] { return !drags() && (at_once || settled_); };
  const double agreed = near ? 0.1 * enough : 0.1 * std::min(1.0, 10 * unbalanced_) * unbalanced_;
  const std::vector<double> from = model_.state();
  solves_.once({part_, (at_once || drags()) && !near ? 1e-3 : 0.0});
  if (limits_follow()) solves_.turn_limits(std::max(agreed, 0.1 * enough), part_);
  const LineSearch search(model_, given_.external, from, given_.anchor);
  const double before_drag = drags() ? 0.0 : solves_.held_back(search.move());
  const double share = search.find(before_drag > enough ? farthest : 1.0);
  search.go(share, from, model_.state());
  const auto gaps = search.gaps(share);
  const bool whole = share >= 1.0;
  settled_ = whole && contact.settled(gaps);
  const auto limits = limits_follow() ? contact.limits_at(gaps) : contact.limits();
  const auto change = contact.respond(gaps, limits);
  // bodies that only others hold are let go little by little
  const double before = weak_;
  if (whole && !drags()) weak_ = std::max(weakest, 0.3 * weak_);
  if (change.springs || (weak_ != before && model_.has_weak_springs()))
    model_.renew_stiffness(weak_);
  constexpr double tiny = std::numeric_limits<double>::min();
  const double largest = std::max({change.largest, change.unbalanced, tiny});
  unbalanced_ = (drags() ? change.at_limits : change.unbalanced) / largest;
  limits_off_ = change.unbalanced / largest;
  pulled_ = drags() ? solves_.held_back(from_anchor()) : before_drag;
  // rounding keeps solves from being exact when loose bodies have gone far
  const double wanted = drags() ? 0.1 * enough : part_ * tolerance;
  balanced_to_ = balance_after(solves_.slowest(), wanted, enough, solves_.rounding(change.largest));
  cut_short_ += share < short_move;
  return share == 1.0 && unbalanced_ <= balanced_to_ && (drags() || pulled_ <= enough);
}

std::vector<double> FaceTurns::from_anchor() const {
  std::vector<double> move = model_.state();
  for (std::size_t k = 0; k < move.size(); ++k) move[k] -= given_.anchor[k];
  return move;
}

}  // namespace cdca
