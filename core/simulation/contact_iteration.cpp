// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/contact_iteration.hpp"

#include "core/base/errors.hpp"
#include "core/mechanics/face_barrier.hpp"
#include "core/simulation/contact_solves.hpp"
#include "core/simulation/creep.hpp"
#include "core/simulation/face_balance.hpp"
#include "core/simulation/face_turns.hpp"
#include "core/simulation/stuck_faces.hpp"

#include <sstream>

namespace cdca {

namespace {

constexpr int most_creeping = 600;  ///< turns of creep

void set_held(Model& model, const std::vector<double>& held) {
  std::vector<double>& state = model.state();
  model.stiffness().clear_held(state);
  for (std::size_t k = 0; k < held.size(); ++k) state[k] += held[k];
  model.stiffness().halo().copy_state(state);
}

SolverReport settle(Model& model, const EquilibriumSolver& solver, double load_factor,
                    FaceMotion motion, Forces& given, Equilibrium& result) {
  constexpr int most = 500;
  const double enough = 10 * model.spec().solver.tolerance;
  ContactSolves solves(model, solver, load_factor, given);
  const Model::ContactMemory at_first = model.contact_memory();
  std::vector<double> origin = model.origin();
  model.stiffness().halo().copy_state(origin);
  set_held(model, given.held);
  const auto go_back = [&] {
    model.remember(at_first);
    model.state() = origin;
    set_held(model, given.held);
  };
  FaceTurns turns(model, solves, given, {enough, most});
  int crept_turns = 0;
  const auto note = [&](double unbalanced) {
    result.contact_iterations = turns.count() + crept_turns;
    result.contact_unbalanced = unbalanced;
    result.linear_solves = solves.count();
  };
  const auto creep = [&] {
    // friction depends on the way, which begins where the faces have been
    go_back();
    given.anchor.clear();
    Equilibrium::BeforeCreep loaded;
    try {
      const auto gaps = model.contact_spots().gaps(origin, model.contact(), model.communicator());
      loaded = load_with_stuck_faces(model, solves, given, gaps);
    } catch (const SolveError&) {
      return false;
    }
    model.remember(at_first);
    const Crept crept = creep_to_balance(model, solves, given, enough, most_creeping);
    if (crept.found) result.before_creep = std::move(loaded);
    crept_turns += crept.turns + crept.steps;
    note(crept.unbalanced);
    if (crept.slides_off) {
      std::ostringstream text;
      text << "at load factor " << load_factor
           << " a part of the body slides off, and nothing stops it.";
      throw SlidesOff(text.str());
    }
    return crept.found;
  };
  // loose bodies can run so far that no solve is exact any more
  const auto turn_or_go_back = [&] {
    try {
      return turns.turn();
    } catch (const SolveError&) {
      if (!model.has_weak_springs() || !FaceBarrier::suits(model.contact())) throw;
      go_back();
      return FaceTurns::End::jammed;
    }
  };
  int jams = 0;
  while (turns.count() < most) {
    const FaceTurns::End end = turn_or_go_back();
    note(turns.unbalanced());
    if (end == FaceTurns::End::balanced) return solves.slowest();
    if (end == FaceTurns::End::too_many || !FaceBarrier::suits(model.contact())) continue;
    const Model::ContactMemory memory = model.contact_memory();
    const std::vector<double> state = model.state();
    if (++jams == 2 && motion == FaceMotion::creeping) {
      if (creep()) return solves.slowest();
      model.remember(memory);
      model.state() = state;
    }
    FaceBalance::Rule rule{enough};
    if (jams == 1) rule.near = FaceTurns::nearly;
    // where these fail on the condensed body, bodies have mostly come loose, and creep comes
    // through
    rule.turns_alone = jams == 1 && model.condenses();
    const auto balance = FaceBalance(model, solves, given, rule).find();
    turns.add_to_count(balance.steps);
    note(balance.unbalanced);
    if (balance.found) return solves.slowest();
    if (balance.unbalanced > FaceTurns::nearly) {
      model.remember(memory);
      model.state() = state;
    }
    turns.begin_again();
  }
  if (motion == FaceMotion::creeping && jams < 2 && creep()) return solves.slowest();
  std::ostringstream text;
  text << "the contact of crack faces at load factor " << load_factor << " did not settle in "
       << result.contact_iterations << " iterations; smaller load steps may help.";
  throw ContactError(text.str());
}

}  // namespace

SolverReport settle_contact(Model& model, const EquilibriumSolver& solver, double load_factor,
                            FaceMotion motion, Forces& given, Equilibrium& result) {
  try {
    return settle(model, solver, load_factor, motion, given, result);
  } catch (const ContactError&) {
    throw;
  } catch (const SolveError& error) {
    // springs of faces may stand in such proportions that no solve is exact
    throw ContactError(std::string("the contact of crack faces did not settle: ") + error.what());
  }
}

}  // namespace cdca
