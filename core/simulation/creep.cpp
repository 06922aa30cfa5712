// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/creep.hpp"

#include "core/base/errors.hpp"
#include "core/simulation/face_turns.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

Crept creep_to_balance(Model& model, ContactSolves& solves, Forces& given, double enough,
                       int most) {
  constexpr int most_turns = 25;
  constexpr double at_first = 1e-2, firmest = 1e4, loosest = 1e-9;
  constexpr double less = 0.4, more = 5;        // drag after steps that succeed, and that do not
  constexpr double roughly = 1e-5, part = 0.1;  // of forces, on the way
  constexpr double at_rest = 1e-6;              // forces that drag takes, as a part of all
  const Model::ContactMemory first_memory = model.contact_memory();
  const std::vector<double> first = model.state();
  Crept crept;
  double drag = at_first, close = roughly;
  int in_a_row = 0;
  model.hold_all_bodies(true);
  for (int k = 0; k < most && drag < firmest && !crept.found; ++k) {
    const Model::ContactMemory memory = model.contact_memory();
    const std::vector<double> state = model.state();
    FaceTurns turns(model, solves, given, {close, most_turns, drag});
    bool balanced = false;
    try {
      balanced = turns.turn() == FaceTurns::End::balanced;
    } catch (const SolveError&) {
      // springs of faces so different that no solve is exact; more drag helps here, too
    }
    crept.turns += turns.count();
    crept.unbalanced = turns.unbalanced();
    if (!balanced) {
      model.remember(memory);
      model.state() = state;
      drag *= more;
      in_a_row = 0;
      continue;
    }
    const bool rests = turns.pulled() <= at_rest;
    crept.found = rests && close == enough;
    if (crept.found) break;
    close = rests ? enough : std::clamp(part * turns.pulled(), enough, roughly);
    model.let_slip();
    drag = std::max(loosest, drag * std::pow(less, std::clamp(++in_a_row - 1, 1, 4)));
  }
  model.hold_all_bodies(false);
  given.drags = false;
  given.anchor.clear();
  if (!crept.found) {
    model.remember(first_memory);
    model.state() = first;
  }
  solves.build_stiffness(loosest);  // without the drag
  return crept;
}

}  // namespace cdca
