// SPDX-License-Identifier: BSD-3-Clause
/// Cracks that join in a loaded plate: every kind of meeting leaves a body that can be solved, cut
/// as the meeting says, whatever the place of the junction in the grid.
#include "core/cracks/meetings.hpp"
#include "core/mechanics/interaction_integral.hpp"
#include "core/simulation/linear_solve.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace cdca::testing {
namespace {

using Polylines = std::vector<std::vector<Vec2>>;

/// A step of a tip: crack, end and the vector by which it grows.
struct Step {
  int crack;
  int end;
  Vec2 by;
};

/// 20 x 16 in elements of half a unit, pulled upwards at its upper side.
CaseSpec pulled(const Polylines& cracks) {
  CaseSpec spec = plate({0, 0}, {20, 16}, 40, 32);
  for (const auto& points : cracks) add_crack(spec, points);
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom);
  top.displacement = constant_load(0, 1e-3);
  bottom.displacement = constant_load(0, 0);
  spec.boundaries = {top, bottom};
  spec.solver.tolerance = 1e-10;
  spec.solver.coarsest_nodes = 200;
  return spec;
}

/// The plate after the steps have been made and met what they meet.
struct Joined {
  std::unique_ptr<Model> model;
  Equilibrium equilibrium;

  Joined(const Polylines& cracks, const std::vector<Step>& steps) : model(built(pulled(cracks))) {
    std::vector<Increment> incs;
    for (const Step& s : steps) {
      const Vec2 from = model->registry().cracks()[std::size_t(s.crack)].end_point(s.end);
      incs.push_back({s.crack, s.end, from, from + s.by});
    }
    const double touch = model->touch_distance();
    CrackRegistry registry = model->registry();
    apply_increments(resolve_meetings(registry, model->body(), touch, incs), touch, {1, 0},
                     registry);
    model->lay_cracks(registry);
    equilibrium = find_equilibrium(*model, *make_solver(*model), 1.0);
  }
  const CrackRegistry& registry() const { return model->registry(); }
  std::size_t bodies() const { return model->bodies().list().size(); }
  int ends_in(TipState state) const {
    int count = 0;
    for (const Crack& crack : registry().cracks())
      for (const CrackEnd& end : crack.ends) count += end.state == state;
    return count;
  }
};

/// Strain energy of the plate without cracks.
double whole() {
  static const double energy = solved(pulled({})).equilibrium.strain_energy;
  return energy;
}

void expect_sound(const Joined& joined) {
  const double energy = joined.equilibrium.strain_energy;
  EXPECT_TRUE(energy > 0.1 * whole() && energy < whole()) << energy / whole();
  EXPECT_LE(joined.equilibrium.solver.iterations, 40);
  for (const StressIntensity& k : joined.model->stress_intensities(1.0)) {
    EXPECT_TRUE(std::isfinite(k.k1) && std::isfinite(k.k2));
  }
}

Vec2 polar(double degrees, double length) {
  const double a = degrees * std::numbers::pi / 180;
  return {length * std::cos(a), length * std::sin(a)};
}

TEST(Joining, ACrackThatGrowsIntoItselfCutsOutAnIsland) {
  const Joined j({{{4, 6}, {12, 6.3}, {11.7, 9}, {8, 8.8}}}, {{0, 1, Vec2(-0.4, -3)}});
  EXPECT_EQ(j.ends_in(TipState::coalesced), 1);
  EXPECT_EQ(j.ends_in(TipState::active), 1);
  EXPECT_EQ(j.bodies(), 2u);
  EXPECT_EQ(j.model->loose_bodies().size(), 1u);
  expect_sound(j);
}

TEST(Joining, TheTwoTipsOfOneCrackCloseALoop) {
  const Joined j({{{11, 7.3}, {8, 6}, {7.9, 10}, {11, 8.9}}},
                 {{0, 0, Vec2(-0.1, 1.2)}, {0, 1, Vec2(0.1, -1.2)}});
  EXPECT_EQ(j.ends_in(TipState::connected), 2);
  EXPECT_EQ(j.bodies(), 2u);
  expect_sound(j);
}

TEST(Joining, ThreeCracksMeetInOneElement) {
  for (const double turn : {0.0, 17.0, 41.0}) {
    for (const Vec2& centre : {Vec2(10.23, 8.31), Vec2(10, 8), Vec2(10.25, 8)}) {
      Polylines star;
      std::vector<Step> steps;
      for (int k = 0; k < 3; ++k) {
        const Vec2 out = polar(90 + turn + 120 * k, 1);
        star.push_back({centre + 3.5 * out, centre + 0.6 * out});
        steps.push_back({k, 1, -0.8 * out});
      }
      const Joined j(star, steps);
      EXPECT_EQ(j.ends_in(TipState::active), 3);
      const Vec2 met = j.registry().cracks()[0].points.back();
      for (const Crack& crack : j.registry().cracks()) EXPECT_EQ(crack.points.back(), met);
      EXPECT_EQ(j.bodies(), 1u);
      expect_sound(j);
    }
  }
}

TEST(Joining, ATipArrivesAtAJunction) {
  const Joined j({{{6, 8}, {14, 8.2}}, {{10, 11.2}, {10, 8.1}}, {{9, 5}, {10.0275, 7}}},
                 {{2, 1, Vec2(0.2, 1.4)}});
  EXPECT_EQ(j.registry().cracks()[2].points.back(), j.registry().cracks()[1].points.back());
  EXPECT_EQ(j.ends_in(TipState::coalesced), 2);
  expect_sound(j);
}

TEST(Joining, AGrazedFaceIsJoinedUnderAnyAngle) {
  for (const double angle : {0.05, 0.3, 1.0, 3.0, 10.0}) {
    // 0.4 elements aside of the tip, met after less than a step or not at all
    const Joined j({{{4, 7.83}, {9, 8.03}}, {{3, 8.23}, {17, 8.23}}}, {{0, 1, polar(angle, 2)}});
    const bool met = std::tan(angle * std::numbers::pi / 180) * 2 > 0.2;
    EXPECT_EQ(j.ends_in(TipState::coalesced), met ? 1 : 0) << angle;
    expect_sound(j);
    // already within two hundredths of an element
    const Joined near({{{4, 8}, {9, 8.22}}, {{3, 8.23}, {17, 8.23}}}, {{0, 1, polar(angle, 2)}});
    expect_sound(near);
  }
}

TEST(Joining, HeadOnTipsMeetMidway) {
  for (const double offset : {0.0, 1e-6, 1e-3, 0.03, 0.3}) {
    const Joined j({{{5, 8.1}, {9.1, 8.1}}, {{15, 8.1 + offset}, {10.7, 8.1 + offset}}},
                   {{0, 1, Vec2(1.5, 0)}, {1, 1, Vec2(-1.5, 0)}});
    EXPECT_EQ(j.ends_in(TipState::connected), 2) << offset;
    EXPECT_LT((j.registry().cracks()[0].points.back() - Vec2(9.9, 8.1 + offset / 2)).norm(), 1e-5);
    expect_sound(j);
  }
}

/// Cells keep the functions of a tip that has joined another crack: at the same displacements of
/// the supports the body stores no more than before, also where it hangs on a neck that is as wide
/// as the elements.
TEST(Joining, GivesNoEnergyBack) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 60; ++k) {
    // two notches that leave a neck, and a crack in it that comes to the first one
    const double height = 7.5 + share(engine), end = 8 + 2 * share(engine);
    const Vec2 notch(end, height), other(end + 0.3 + share(engine), height + 0.5 + share(engine));
    const Vec2 tip(end - 0.3 + 0.6 * share(engine), height + 0.1 + 0.3 * share(engine));
    const Vec2 tail = tip + polar(20 + 140 * share(engine), 1.2);
    const Polylines cracks{{{0, height}, notch}, {{20, other.y()}, other}, {tail, tip}};
    const Joined before(cracks, {}), after(cracks, {{2, 1, Vec2(0.0, -0.5)}});
    EXPECT_NE(after.registry().cracks()[2].ends[1].state, TipState::active);
    EXPECT_LT(after.equilibrium.strain_energy, before.equilibrium.strain_energy) << "case " << k;
  }
}

/// Before the new crack opens, the body strains as it did: a step that joins a wall in front of the
/// tip takes nothing from the field.
TEST(Joining, LeavesTheFieldAsItWasUntilTheCrackOpens) {
  for (const double turn : {-60.0, -20.0, 0.0, 35.0, 60.0}) {
    const Polylines cracks{{{4, 7.83}, {8.93, 8.03}}, {{9.9, 4.2}, {9.9, 12.1}}};
    const auto model = built(pulled(cracks));
    const auto energy = [&] {
      return 0.5 * model->stiffness().dot(model->state(), inner_forces(*model));
    };
    find_equilibrium(*model, *make_solver(*model), 1.0);
    const double before = energy(), touch = model->touch_distance();
    const Vec2 from = cracks[0].back();
    CrackRegistry registry = model->registry();
    apply_increments(
        resolve_meetings(registry, model->body(), touch, {{0, 1, from, from + polar(turn, 2)}}),
        touch, {1, 0}, registry);
    ASSERT_EQ(registry.cracks()[0].ends[1].state, TipState::coalesced) << turn;
    model->lay_cracks(registry);
    EXPECT_NEAR(energy(), before, 1e-8 * before) << turn;
  }
}

/// A crack from the rim to a stem: two bodies wherever they meet, and an energy that hardly changes
/// as the place moves past a node, a grid line or a kink.
TEST(Joining, DoesNotDependOnThePlaceInTheGrid) {
  const auto energy = [](const Vec2& at) {
    // the face that is met runs through `at` and has a kink a little aside of it
    const Joined j({{{10.3, 0}, at + Vec2(0.1, -2.2), at + Vec2(-0.05, 1.1), {9.8, 12}},
                    {{0, 7.8}, at + Vec2(-0.7, 0.04)}},
                   {{1, 1, Vec2(1.2, -0.04)}});
    EXPECT_EQ(j.bodies(), 2u) << at.transpose();
    EXPECT_EQ(j.registry().active_tips(), 1) << at.transpose();
    return j.equilibrium.strain_energy;
  };
  for (const Vec2& place : {Vec2(10, 8), Vec2(10.25, 8), Vec2(10, 8.25)}) {
    const double here = energy(place);
    for (int k = 0; k < 4; ++k) {
      for (const double off : {1e-9, 3e-7, 6e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
        EXPECT_NEAR(energy(place + polar(90 * k + 33, off)), here, 1e-3 * here) << k << " " << off;
      }
    }
  }
}

TEST(Joining, EndsNextToAKinkOrATipOfThePartner) {
  for (const double off : {1e-7, 1e-5, 4e-4, 6e-4, 1e-2}) {
    for (const int side : {-1, 1}) {
      const Vec2 kink(10.1, 8.2), at = kink + Vec2(0, side * off);
      const Joined bent({{{9.5, 3}, kink, {9.4, 12}}, {{4, 8.1}, {9.3, at.y()}}},
                        {{1, 1, Vec2(1.3, 0)}});
      EXPECT_EQ(bent.ends_in(TipState::coalesced), 1) << off;
      expect_sound(bent);
      // passing over the tip of a crack from below
      const Joined tip({{{10.1, 4}, kink}, {{4, 8.1}, {9.3, at.y()}}}, {{1, 1, Vec2(1.3, 0)}});
      EXPECT_NE(tip.registry().cracks()[1].ends[1].state, TipState::active) << off;
      expect_sound(tip);
    }
  }
}

/// Two tips in one element, both with near-tip functions, as close as growth may bring them: the
/// closer, the softer, but never as soft as when they have met.
TEST(Joining, TipsThatComeCloseDoNotDisturbTheSolve) {
  for (int k = 0; k < 4; ++k) {
    const Vec2 centre(10.21 + 0.03 * k, 8.17);
    const Joined one({{{5, 7.6}, centre}, {{15, 8.7}, centre}}, {});
    EXPECT_EQ(one.registry().active_tips(), 2);
    double before = whole();
    for (const double gap : {0.5, 0.1, 0.02, 0.005, 0.0011}) {
      const Vec2 half = polar(20 + 10 * k, 0.25 * gap);
      const Joined j({{{5, 7.6}, centre - half}, {{15, 8.7}, centre + half}}, {});
      EXPECT_EQ(j.registry().active_tips(), 4);
      expect_sound(j);
      EXPECT_LT(j.equilibrium.strain_energy, before) << gap;
      before = j.equilibrium.strain_energy;
    }
    EXPECT_GT(before, one.equilibrium.strain_energy);
  }
}

/// Collinear cracks in tension: the inner tips run into each other and the crack goes on as one.
TEST(Joining, CollinearCracksGrowTogether) {
  CaseSpec spec = pulled({{{5.03, 8.1}, {8.63, 8.1}}, {{14.97, 8.1}, {11.37, 8.1}}});
  spec.material.toughness = 0.05;
  spec.growth.criterion = Criterion::hoop;
  spec.growth.fixed_step = true;
  spec.growth.step_length = {1.5, 1.5};
  spec.loading.critical = true;
  spec.loading.max_events = 6;
  const Summary s = run_simulation(spec, "test", world(), world_partitioner(), {});
  std::vector<EventRecord> met;
  std::copy_if(s.events.begin(), s.events.end(), std::back_inserter(met),
               [](const EventRecord& e) { return e.kind == "connection"; });
  ASSERT_EQ(met.size(), 2u);
  for (const EventRecord& e : met) {
    EXPECT_LT((e.at - Vec2(10, 8.1)).norm(), 0.05);
    EXPECT_EQ(e.partner, 1 - e.crack);
  }
  EXPECT_EQ(s.network.clusters, 1);
  EXPECT_EQ(s.status, "completed");
}

}  // namespace
}  // namespace cdca::testing
