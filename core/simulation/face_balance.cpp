// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/face_balance.hpp"

#include "core/base/errors.hpp"
#include "core/mechanics/body_at_faces.hpp"
#include "core/mechanics/condensed_turns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cdca {

namespace {

constexpr int most_steps = 150;
constexpr int most_restarts = 100;  ///< of steps that are stuck
/// With the condensed body, where tractions are balanced well enough: they cost little, and what is
/// out of balance counts as lost in energies.
constexpr int more_steps = 2;
/// Rounds with the condensed body from where loose bodies have gone, and what weak springs may add
/// to the forces after these, as a part of what is enough: their way counts in energies, too.
constexpr int most_rounds = 4;
constexpr double pulled_at_most = 0.1;
constexpr double agreeing = 1e-3, of_unbalanced = 1e-2;  ///< limits of friction and pressures
constexpr double nearly = 1e-4;  ///< balanced: solves are exact from here on
/// Of a solve's tolerance: it ends where rounding ends it. A solve that begins far away leaves more
/// in the gaps of stiff faces than its residual tells.
constexpr double to_rounding = 1e-12;

double greatest_difference(const std::vector<FaceTraction>& a, const std::vector<FaceTraction>& b) {
  double greatest = 0.0;
  for (std::size_t p = 0; p < a.size(); ++p) {
    greatest = std::max({greatest, std::abs(a[p].normal - b[p].normal),
                         std::abs(a[p].tangential - b[p].tangential)});
  }
  return greatest;
}

}  // namespace

FaceBalance::FaceBalance(Model& model, ContactSolves& solves, Forces& given, const Rule& rule)
    : model_(model),
      solves_(solves),
      given_(given),
      rule_(rule),
      weak_(rule.drag > 0.0 ? rule.drag : ContactSolves::loosest),
      limits_(rule.limits_stay ? FrictionLimits::stay : FrictionLimits::follow_pressures),
      compliances_(model.contact_spots().compliances(model.contact(), model.communicator())),
      softness_(model.grid().smallest_side() / model.spec().material.young),
      held_(model.contact(), compliances_, softness_, limits_),
      faces_(model.contact(), compliances_, solves.gaps(), softness_, limits_),
      nearest_(model.state()) {}

FaceBalance::Found FaceBalance::find() {
  // lest the faces, each a little pressed, drive loose bodies far apart
  if (!drags()) given_.anchor = model_.state();
  if (model_.condenses()) {
    try {
      while (anchored_anew_ && rounds_ < 2 * most_rounds) go_condensed();
    } catch (const SolveError&) {
      model_.state() = nearest_;
      left_ = 1.0;
    }
  }
  if (rule_.turns_alone) gave_up_ = true;
  while (!now_.found && !gave_up_ && now_.steps < most_steps) step_whole();
  if (!drags()) given_.anchor.clear();
  if (!now_.found) {
    model_.state() = nearest_;
    now_.unbalanced = least_;
  }
  ContactPatches& contact = model_.contact();
  const auto here = solves_.gaps();
  contact.respond(here, rule_.limits_stay ? contact.limits() : contact.limits_at(here));
  // with drag, the next step has springs of its own
  if (!drags()) model_.renew_stiffness(weak_);
  solves_.set_forces_of_faces();
  return now_;
}

double FaceBalance::agreement() const {
  return std::clamp(of_unbalanced * now_.unbalanced, of_unbalanced * rule_.enough, agreeing);
}

void FaceBalance::go_condensed() {
  anchored_anew_ = false;
  ++rounds_;
  std::vector<ContactGap> at = solves_.gaps();
  const auto closed = held_.closed();
  solves_.answer(closed);
  model_.renew_stiffness(weak_);
  solves_.once({});
  condensed_ = true;
  const auto closed_gaps = solves_.gaps();
  FacesOfBody& condensed = model_.condensed(closed);
  const double left_before = left_, unbalanced_before = now_.unbalanced;
  if (turn_condensed(condensed, closed_gaps, at) || rule_.turns_alone) return;
  left_ = left_before;
  now_.unbalanced = unbalanced_before;
  BodyAtFaces body(condensed.places, condensed.compliance, closed_gaps, model_.communicator());
  struct Place {
    FaceBarrier faces;
    std::vector<ContactGap> gaps;
    double left;
  };
  Place nearest{faces_, at, left_};
  double least = 1.0;
  int after_enough = 0;
  bool goes_on = true;
  while (goes_on && now_.steps < most_steps) {
    ++now_.steps;
    std::vector<ContactGap> there = at;
    double share = 0.0;
    try {
      share =
          faces_.step([&](const auto& answers) { return there = body.gaps(answers); }, agreement());
    } catch (const SolveError&) {
      break;
    }
    for (std::size_t p = 0; p < at.size(); ++p) {
      at[p].normal += share * (there[p].normal - at[p].normal);
      at[p].tangential += share * (there[p].tangential - at[p].tangential);
    }
    left_ = faces_.began_anew() ? 1.0 : (1 - share) * left_;
    now_.unbalanced = held_.unbalanced(faces_.tractions(), at);
    if (off() < least) {
      least = off();
      nearest = {faces_, at, left_};
    }
    if (least <= rule_.enough) {
      goes_on = ++after_enough <= more_steps;
    } else {
      gave_up_ = !is_of_use_to_go_on(least);
      goes_on = !gave_up_;
    }
  }
  // the displacements that go with these gaps
  faces_ = std::move(nearest.faces);
  const auto tractions = move_to(nearest.gaps, faces_.tractions());
  left_ = std::max(nearest.left, solves_.slowest().residual);
  judge(tractions);
}

std::vector<FaceTraction> FaceBalance::move_to(const std::vector<ContactGap>& gaps,
                                               const std::vector<FaceTraction>& tractions) {
  solves_.answer(held_.exerting(tractions, gaps));
  solves_.once({});
  return held_.at(solves_.gaps(), tractions, gaps);
}

std::vector<FaceTraction> FaceBalance::move_closer_to(const std::vector<ContactGap>& gaps,
                                                      const std::vector<FaceTraction>& tractions) {
  solves_.once({to_rounding});
  return held_.at(solves_.gaps(), tractions, gaps);
}

bool FaceBalance::turn_condensed(FacesOfBody& condensed, std::vector<ContactGap> closed_gaps,
                                 std::vector<ContactGap> from) {
  constexpr int most = 4;
  for (int k = 0; k < most; ++k) {
    CondensedTurns turns(model_.contact(),
                         {condensed.places, condensed.compliance, closed_gaps, condensed.reference},
                         {rule_.enough, rule_.limits_stay});
    const auto balance = turns.find(from, model_.communicator());
    ++now_.steps;
    if (!balance.found) return false;
    const auto tractions = move_to(balance.gaps, balance.tractions);
    left_ = solves_.slowest().residual;
    judge(tractions);
    if (!now_.found && !anchored_anew_) {
      const auto again = move_closer_to(balance.gaps, balance.tractions);
      noise_ = std::max(noise_, greatest_difference(tractions, again));
      judge(again);
    }
    if (now_.found || anchored_anew_) return true;
    // the whole body tells its gaps better than the condensed one where bodies are nearly loose
    from = solves_.gaps();
    for (std::size_t p = 0; p < from.size(); ++p) {
      closed_gaps[p].normal += from[p].normal - balance.gaps[p].normal;
      closed_gaps[p].tangential += from[p].tangential - balance.gaps[p].tangential;
    }
  }
  return false;
}

void FaceBalance::step_whole() {
  ++now_.steps;
  std::vector<double>& state = model_.state();
  const std::vector<double> before = state;
  bool built = false;
  const auto solve = [&](const std::vector<ContactAnswer>& answers) {
    solves_.answer(answers);
    if (!built) model_.renew_stiffness(weak_);
    built = true;
    solves_.once({1.0, now_.unbalanced > nearly ? of_unbalanced : 0.0});
    return solves_.gaps();
  };
  double share = 0.0;
  try {
    share = faces_.step(solve, agreement());
  } catch (const SolveError&) {
    gave_up_ = true;  // springs so different that no solve is possible with them
    return;
  }
  for (std::size_t k = 0; k < state.size(); ++k)
    state[k] = before[k] + share * (state[k] - before[k]);
  left_ = faces_.began_anew() ? 1.0 : (1 - share) * left_ + share * solves_.slowest().residual;
  judge(faces_.tractions());
  gave_up_ = !is_of_use_to_go_on(least_);
}

bool FaceBalance::is_of_use_to_go_on(double least) {
  if (!faces_.began_anew()) return true;
  return ++restarts_ <= most_restarts && least > rule_.near;
}

void FaceBalance::judge(const std::vector<FaceTraction>& tractions) {
  const std::vector<double>& state = model_.state();
  now_.unbalanced = held_.unbalanced(tractions, solves_.gaps());
  if (off() < least_) {
    least_ = off();
    nearest_ = state;
  }
  double largest = 0.0;
  for (const FaceTraction& t : tractions) largest = std::max(largest, -t.normal);
  // where a body slides far a step on its way need not be as exact as the place where it rests
  const double worst = std::max(ContactSolves::worst_balance, drags() ? 100 * rule_.enough : 0.0);
  const double rounding = largest > 0.0 ? std::min(worst, noise_ / largest) : 0.0;
  const double told_apart = std::max({rule_.enough, solves_.rounding(largest, worst), rounding});
  now_.found = off() <= told_apart;
  if (drags()) return;
  std::vector<double> move = state;
  for (std::size_t k = 0; k < state.size(); ++k) move[k] -= given_.anchor[k];
  const double pulled = solves_.held_back(move);
  const bool cheap = condensed_ && rounds_ < most_rounds;
  if (now_.found && pulled > (cheap ? pulled_at_most : 1.0) * rule_.enough) {
    anchored_anew_ = true;
    given_.anchor = state;
    left_ = pulled;
    now_.found = false;
  }
}

}  // namespace cdca
