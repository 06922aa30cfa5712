// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/creep.hpp"

#include "core/base/errors.hpp"
#include "core/simulation/face_balance.hpp"
#include "core/simulation/face_turns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cdca {

namespace {

struct DragStep {
  bool balanced = false;
  int turns = 0, steps = 0;
  double limits_off = 1.0, pulled = 0.0;  ///< as of FaceTurns
  bool limits_agree = false;
};

/// All faces at once. limits_go_along: those of friction follow the pressures, if this leads to a
/// balance.
FaceBalance::Found balance(Model& model, ContactSolves& solves, Forces& given,
                           const FaceTurns::Rule& rule, bool limits_go_along) {
  // where faces do not soon come into balance on the condensed body, more drag costs less than
  // interior points
  const FaceBalance::Rule all{.enough = rule.enough,
                              .drag = rule.drag,
                              .limits_stay = true,
                              .turns_alone = model.condenses()};
  if (!limits_go_along) return FaceBalance(model, solves, given, all).find();
  const Model::ContactMemory memory = model.contact_memory();
  const std::vector<double> state = model.state();
  FaceBalance::Rule along = all;
  along.limits_stay = false;
  along.turns_alone = true;
  const FaceBalance::Found at_once = FaceBalance(model, solves, given, along).find();
  if (at_once.found) return at_once;
  model.remember(memory);
  model.state() = state;
  FaceBalance::Found found = FaceBalance(model, solves, given, all).find();
  found.steps += at_once.steps;
  return found;
}

DragStep step(Model& model, ContactSolves& solves, Forces& given, const FaceTurns::Rule& rule,
              bool limits_go_along) {
  try {
    FaceTurns turns(model, solves, given, rule);
    const FaceTurns::End end = turns.turn();
    FaceBalance::Found found{.found = end == FaceTurns::End::balanced};
    if (end == FaceTurns::End::jammed) {
      found = balance(model, solves, given, rule, limits_go_along);
      turns.take(found.unbalanced);
    }
    return {found.found,        turns.count(),  found.steps,
            turns.limits_off(), turns.pulled(), turns.limits_agree()};
  } catch (const SolveError&) {
    return {};  // springs of faces so different that no solve is exact; more drag helps here, too
  }
}

/// Limits of friction do not go farther at once, as a part of the largest traction: what rubs on
/// the way is counted.
constexpr double most_off = 0.01;

/// Bodies that drag no longer holds up still slide on for as long as limits of friction are not
/// what pressures ask for. Where they come no nearer to that from step to step, they go farther at
/// once.
/// off: what they are off by now, and were in the step before.
double next_ahead(double ahead, double off, double off_before) {
  constexpr double nearer = 0.7, farther = 1.5, most = 32;
  const double change = off / off_before;
  if (change > farther) return 1.0;
  const double next = change > nearer ? 2 * ahead : ahead;
  return std::max(1.0, std::min({most, next, most_off / off}));
}

/// How far the farthest place has gone since, m. Collective.
double way_from(const std::vector<double>& before, const Model& model) {
  double farthest = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k)
    farthest = std::max(farthest, std::abs(model.state()[k] - before[k]));
  return model.communicator().max(farthest);
}

}  // namespace

Crept creep_to_balance(Model& model, ContactSolves& solves, Forces& given, double enough,
                       int most) {
  constexpr int most_turns = 50, most_steps = 150;
  constexpr double at_first = 1e-2, firmest = 1e4;
  constexpr double less = 0.4, more = 5;        // drag after steps that succeed, and that do not
  constexpr double roughly = 1e-5, part = 0.1;  // of forces, on the way
  constexpr double at_rest = 1e-6;              // what drag takes, as a part of the loads
  const Model::ContactMemory first_memory = model.contact_memory();
  const std::vector<double> first = model.state();
  Crept crept;
  double drag = at_first, close = roughly;
  double ahead = 1.0, off_before = 1.0, pulled_before = 0.0;
  bool limits_go_along = false;
  int in_a_row = 0;
  model.hold_all_bodies(true);
  for (int k = 0; k < most_steps && crept.turns < most && drag < firmest; ++k) {
    const Model::ContactMemory memory = model.contact_memory();
    const std::vector<double> state = model.state();
    const DragStep now =
        step(model, solves, given, {close, most_turns, drag, ahead}, limits_go_along);
    crept.turns += now.turns;
    crept.steps += now.steps;
    crept.unbalanced = now.limits_off;
    if (!now.balanced) {
      model.remember(memory);
      model.state() = state;
      drag *= more;
      in_a_row = 0;
      continue;
    }
    const bool rests = now.pulled <= at_rest;
    // less drag, and as much to pull: nothing stops it
    const bool goes_on = !rests && now.pulled > 0.5 * std::exchange(pulled_before, now.pulled);
    crept.slides_off = goes_on && way_from(first, model) > model.grid().size().maxCoeff();
    if (crept.slides_off) break;
    crept.found = rests && close == enough && now.limits_agree;
    if (crept.found) break;
    ahead = rests ? next_ahead(ahead, now.limits_off, off_before) : 1.0;
    off_before = now.limits_off;
    limits_go_along = rests && model.condenses() && now.limits_off <= most_off;
    close = rests ? enough : std::clamp(part * now.pulled, enough, roughly);
    model.let_slip();
    const int power = std::clamp(++in_a_row - 1, 1, 4);
    drag = std::max(ContactSolves::loosest, drag * std::pow(less, power));
  }
  model.hold_all_bodies(false);
  given.drags = false;
  given.anchor.clear();
  if (!crept.found) {
    model.remember(first_memory);
    model.state() = first;
  }
  model.renew_stiffness(ContactSolves::loosest);  // without the drag
  return crept;
}

}  // namespace cdca
