// SPDX-License-Identifier: BSD-3-Clause
/// Touching faces stick, slip, open and drive wings alike on any number of ranks, with rank borders
/// along them and across them.
#include "core/mechanics/body_at_faces.hpp"
#include "core/mechanics/condensed_turns.hpp"
#include "core/mechanics/held_faces.hpp"
#include "core/mechanics/interaction_integral.hpp"
#include "core/simulation/contact_solves.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/failing_solver.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace cdca::testing {
namespace {

constexpr int nx = 24, ny = 32;
constexpr double h = 0.05;

Partitioner all_in_one() {
  return [](const PartitionGraph& graph, int) { return std::vector<int>(graph.weights.size(), 0); };
}

/// Horizontal strips: their borders run along y = 0.4, 0.8 and 1.2.
Partitioner strips() {
  return [](const PartitionGraph& graph, int parts) {
    std::vector<int> owner;
    for (int k = 0; k < int(graph.weights.size()); ++k)
      owner.push_back(std::min(k / (nx + 1) * parts / ny, parts - 1));
    return owner;
  };
}

/// Every few cells have another owner.
Partitioner scattered() {
  return [](const PartitionGraph& graph, int parts) {
    std::vector<int> owner;
    for (int k = 0; k < int(graph.weights.size()); ++k)
      owner.push_back((k % (nx + 1) / 3 + 2 * (k / (nx + 1) / 4)) % parts);
    return owner;
  };
}

void add_touching(CaseSpec& spec, std::vector<Vec2> points, double friction) {
  add_crack(spec, std::move(points));
  spec.cracks.back().contact = {ContactLaw::coulomb, 1e7, 1e5, friction, 0.0, 0.0, 0.0};
}

/// Pressed from above by 1, sheared by the load factor.
CaseSpec sheared() {
  CaseSpec spec = plate({0, 0}, {nx * h, ny * h}, nx, ny);
  add_touching(spec, {{0.14, 1.16}, {0.52, 1.43}}, 0.3);
  add_touching(spec, {{0.55, 0.8}, {1.05, 0.8}}, 0.3);  // on a rank border
  add_touching(spec, {{0.25, 0.13}, {0.24, 0.3}, {0.53, 0.57}, {0.54, 0.72}}, 0.1);  // with wings
  add_touching(spec, {{0.85, 0.2}, {0.85, 0.6}}, 0.2);
  add_touching(spec, {{0.66, 1.05}, {1.08, 1.33}}, 0.4);
  add_touching(spec, {{0.7, 1.5}, {0.8784, 1.1956}}, 0.4);  // a T
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom);
  top.traction[0] = proportional_load(1);
  top.traction[1] = LoadValue{[](double, double, double) { return -1.0; }, false, "-1"};
  bottom.displacement = constant_load(0, 0);
  spec.boundaries = {top, bottom};
  spec.solver.tolerance = 1e-11;
  return spec;
}

struct Answer {
  std::vector<ContactPatch> patches;
  std::vector<StressIntensity> tips;
  double friction = 0.0;
};

/// After a load history of three steps.
Answer answer(Communicator& ranks, const Partitioner& partitioner) {
  Model model(sheared(), ranks, partitioner);
  model.build_stiffness();
  Answer a;
  for (const double s : {0.1, 0.4, 0.7}) {
    find_equilibrium(model, *make_solver(model), s);
    a.friction += model.accept_contact();
  }
  a.patches = model.contact().patches();
  a.tips = model.stress_intensities(0.7);
  return a;
}

TEST(ContactParallel, SameStatesTractionsAndIntensities) {
  SerialCommunicator serial;
  const Answer one = answer(serial, all_in_one());
  std::set<ContactState> states;
  for (const ContactPatch& p : one.patches) states.insert(p.now.state);
  EXPECT_EQ(states.size(), 3U) << "some faces stick, some slip, some are open";
  EXPECT_GT(one.friction, 0.0);
  for (const Partitioner& partitioner : {strips(), scattered(), world_partitioner()}) {
    const Answer many = answer(world(), partitioner);
    EXPECT_NEAR(many.friction, one.friction, 1e-7 * one.friction);
    ASSERT_EQ(many.patches.size(), one.patches.size());
    for (std::size_t k = 0; k < one.patches.size(); ++k) {
      const ContactPatch &a = one.patches[k], &b = many.patches[k];
      EXPECT_EQ(a.now.state, b.now.state) << "crack " << a.crack << " from " << a.from;
      EXPECT_NEAR(a.now.normal, b.now.normal, 1e-6);
      EXPECT_NEAR(a.now.tangential, b.now.tangential, 1e-6);
    }
    ASSERT_EQ(many.tips.size(), one.tips.size());
    for (std::size_t t = 0; t < one.tips.size(); ++t) {
      EXPECT_NEAR(one.tips[t].k1, many.tips[t].k1, 1e-6);
      EXPECT_NEAR(one.tips[t].k2, many.tips[t].k2, 1e-6);
    }
  }
}

/// The cells' answer to displacements, and the moves that one factor gives them for it.
std::vector<double> answers(const Model& model) {
  const auto all = std::size_t(model.stiffness().count());
  std::vector<double> x(all), forces(all, 0.0), moves(all, 0.0);
  for (std::size_t k = 0; k < all; ++k) x[k] = std::sin(double(7 * k % 1000));
  model.stiffness().apply(x, forces);
  model.hierarchy().scale(0).solve(forces, moves);
  forces.resize(std::size_t(model.stiffness().owned()));
  forces.insert(forces.end(), moves.begin(), moves.begin() + model.stiffness().owned());
  return forces;
}

/// Where one factor moves all cells, springs turn in place: to the last bit as if built anew, rank
/// borders or not, with and without weak springs on all bodies.
TEST(TurnedSpringsParallel, AreAsIfBuiltAnew) {
  Model model(sheared(), world(), scattered());
  model.build_stiffness();
  ASSERT_EQ(model.hierarchy().count(), 1U);
  std::vector<double> before = answers(model);
  for (const bool all_held : {false, true, false}) {
    model.hold_all_bodies(all_held);
    for (std::size_t p = all_held ? 0 : 1; p < model.contact().patches().size(); p += 3)
      model.contact().patches()[p].now = {};  // open
    model.renew_stiffness(1e-4);
    const std::vector<double> turned = answers(model);
    EXPECT_NE(turned, before);
    model.build_stiffness(1e-4);
    EXPECT_EQ(turned, answers(model));
    before = turned;
  }
}

/// Whatever springs the faces have, between those of open and of closed ones: the condensed body
/// moves them as the whole one does.
TEST(CondensedBodyParallel, MovesItsFacesAsTheWholeBody) {
  constexpr double factor = 0.5;
  Model model(sheared(), world(), scattered());
  model.build_stiffness();
  ASSERT_TRUE(model.condenses());
  const auto solver = make_solver(model);
  const std::vector<double> none(model.state().size(), 0.0);
  Forces given{none, none, none};
  add_external_forces(model.basis(), model.loads(factor), given.external);
  ContactSolves solves(model, *solver, factor, given);
  const auto gaps_of_whole = [&](const std::vector<ContactAnswer>& answers) {
    solves.answer(answers);
    model.renew_stiffness(ContactSolves::loosest);
    solves.once({});
    return solves.gaps();
  };
  const auto body_share = model.contact_spots().compliances(model.contact(), model.communicator());
  const auto closed =
      HeldFaces(model.contact(), body_share, 1.0, FrictionLimits::follow_pressures).closed();
  const auto closed_gaps = gaps_of_whole(closed);
  const auto& condensed = model.condensed(closed);
  EXPECT_EQ(condensed.places.size(), 2 * closed.size());
  BodyAtFaces body(condensed.places, condensed.compliance, closed_gaps, world());
  std::mt19937 engine(3);
  std::uniform_real_distribution<> power(-8, 0), zero(-1e-6, 1e-6);
  for (int round = 0; round < 3; ++round) {
    auto answers = closed;
    for (ContactAnswer& a : answers) {
      a.normal_spring *= std::pow(10, power(engine));
      a.tangential_spring *= std::pow(10, power(engine));
      a.normal_zero = zero(engine);
      a.tangential_zero = zero(engine);
    }
    const auto found = body.gaps(answers);
    const auto wanted = gaps_of_whole(answers);
    double largest = 0.0, off = 0.0;
    for (std::size_t p = 0; p < found.size(); ++p) {
      largest = std::max({largest, std::abs(wanted[p].normal), std::abs(wanted[p].tangential)});
      off = std::max({off, std::abs(found[p].normal - wanted[p].normal),
                      std::abs(found[p].tangential - wanted[p].tangential)});
    }
    EXPECT_LT(off, 1e-8 * largest);
  }
}

/// Turns of faces on the condensed body, from far away: with limits of friction that stay, or that
/// follow the pressures, the whole body is in balance with the tractions that they lead to.
TEST(CondensedBodyParallel, TurnsItsFacesToABalanceOfTheWholeBody) {
  constexpr double factor = 0.5, enough = 1e-8;
  for (const bool limits_stay : {true, false}) {
    Model model(sheared(), world(), scattered());
    model.build_stiffness();
    const auto solver = make_solver(model);
    find_equilibrium(model, *solver, 0.1);
    const std::vector<double> none(model.state().size(), 0.0);
    Forces given{none, none, none};
    add_external_forces(model.basis(), model.loads(factor), given.external);
    ContactSolves solves(model, *solver, factor, given);
    ContactPatches& contact = model.contact();
    const auto share = model.contact_spots().compliances(contact, model.communicator());
    const auto from = solves.gaps();
    const HeldFaces faces(contact, share, 1.0,
                          limits_stay ? FrictionLimits::stay : FrictionLimits::follow_pressures);
    const auto limits = contact.limits();
    const auto closed = faces.closed();
    const auto solve = [&](const std::vector<ContactAnswer>& answers) {
      solves.answer(answers);
      model.renew_stiffness(ContactSolves::loosest);
      solves.once({});
      return solves.gaps();
    };
    const auto closed_gaps = solve(closed);
    FacesOfBody& body = model.condensed(closed);
    CondensedTurns turns(contact, {body.places, body.compliance, closed_gaps, body.reference},
                         {enough, limits_stay});
    const auto found = turns.find(from, world());
    ASSERT_TRUE(found.found);
    EXPECT_GT(found.turns, 1);
    const auto gaps = solve(faces.exerting(found.tractions, found.gaps));
    const auto exerted = faces.at(gaps, found.tractions, found.gaps);
    double largest = 0.0, off = 0.0;
    std::set<ContactState> states;
    for (std::size_t p = 0; p < gaps.size(); ++p) {
      const ContactSpec& law = contact.law_of(contact.patches()[p]);
      const double limit = limits_stay ? limits[p] : limit_at(law, gaps[p].normal);
      const ContactAnswer wanted = contact_answer(law, 0.0, gaps[p], limit);
      const FaceTraction& is = exerted[p];
      states.insert(wanted.state);
      largest = std::max({largest, std::abs(is.normal), std::abs(is.tangential)});
      off = std::max(
          {off, std::abs(is.normal - wanted.normal), std::abs(is.tangential - wanted.tangential)});
    }
    EXPECT_EQ(states.size(), 3u) << "faces open, stick and slip";
    EXPECT_LE(off, 10 * enough * largest) << limits_stay;
  }
}

struct Growth {
  double work_before_creep = 0.0, strain_energy = 0.0;
};

/// A crack grows, and solves fail so that bodies creep to the next equilibrium: they may where a
/// part of the plate is held by faces alone.
Growth creep_after_growth(Communicator& ranks, const Partitioner& partitioner) {
  CaseSpec spec = sheared();
  add_touching(spec, {{0.0, 1.53}, {1.2, 1.53}}, 0.9);
  Model model(spec, ranks, partitioner);
  model.build_stiffness();
  const auto solver = make_solver(model);
  find_equilibrium(model, *solver, 0.4);
  model.accept_contact();
  CrackRegistry registry = model.registry();
  const Crack& crack = registry.cracks()[4];
  registry.advance(4, 0, crack.end_point(0) + 1.2 * h * crack.end_tangent(0), TipState::active, -1,
                   {1, 0});
  model.lay_cracks(registry);
  const Equilibrium crept = find_equilibrium(model, Fails(*solver, 1, 2), 0.4);
  Growth found{0.0, crept.strain_energy};
  if (crept.before_creep)
    found.work_before_creep = model.stiffness().dot(crept.external, crept.before_creep->state);
  return found;
}

/// Also at rank borders, faces hold on to each other where they are.
TEST(ContactParallel, CreepsAfterGrowthFromTheSamePlace) {
  SerialCommunicator serial;
  const Growth one = creep_after_growth(serial, all_in_one());
  ASSERT_NE(one.work_before_creep, 0.0) << "nothing has crept";
  for (const Partitioner& partitioner : {strips(), scattered()}) {
    const Growth many = creep_after_growth(world(), partitioner);
    EXPECT_NEAR(many.work_before_creep, one.work_before_creep,
                1e-6 * std::abs(one.work_before_creep));
    EXPECT_NEAR(many.strain_energy, one.strain_energy, 1e-5 * one.strain_energy);
  }
}

/// Two flaws under compression and their wings.
CaseSpec wings() {
  CaseSpec spec = plate({0, 0}, {nx * h, ny * h}, nx, ny);
  add_touching(spec, {{0.24, 0.33}, {0.52, 0.63}}, 0.3);
  add_touching(spec, {{0.65, 0.96}, {0.96, 1.24}}, 0.2);
  pull(spec, {0, -1, 0});
  spec.solver.tolerance = 1e-11;
  spec.material.toughness = 1.0;
  spec.growth.criterion = Criterion::hoop;
  spec.growth.fixed_step = true;
  spec.growth.step_length = {1.2, 1.2};
  spec.loading.critical = true;
  spec.loading.max_events = 4;
  return spec;
}

TEST(ContactParallel, SameWings) {
  SerialCommunicator serial;
  const Summary one = run_simulation(wings(), "test", serial, all_in_one(), {});
  EXPECT_GE(one.steps.back().crack_length, one.steps.front().crack_length + 2.9 * 1.2 * h);
  for (const Partitioner& partitioner : {strips(), scattered()}) {
    const Summary many = run_simulation(wings(), "test", world(), partitioner, {});
    EXPECT_EQ(one.status, many.status);
    ASSERT_EQ(one.steps.size(), many.steps.size());
    for (std::size_t k = 0; k < one.steps.size(); ++k)
      EXPECT_NEAR(one.steps[k].load_factor, many.steps[k].load_factor,
                  1e-6 * one.steps[k].load_factor);
    for (std::size_t c = 0; c < one.cracks.size(); ++c) {
      ASSERT_EQ(one.cracks[c].points.size(), many.cracks[c].points.size());
      for (std::size_t k = 0; k < one.cracks[c].points.size(); ++k)
        EXPECT_LT((one.cracks[c].points[k] - many.cracks[c].points[k]).norm(), 1e-4 * h);
    }
    for (std::size_t t = 0; t < one.tips.size(); ++t) {
      EXPECT_NEAR(one.tips[t].k1, many.tips[t].k1, 1e-6);
      EXPECT_NEAR(one.tips[t].k2, many.tips[t].k2, 1e-6);
    }
  }
}

}  // namespace
}  // namespace cdca::testing
