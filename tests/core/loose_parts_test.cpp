// SPDX-License-Identifier: BSD-3-Clause
/// Parts that growth has cut off and that faces alone hold: they rest, or they slide off.
#include "core/base/errors.hpp"
#include "core/cracks/meetings.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace cdca::testing {
namespace {

ContactSpec rough(double friction, double h) {
  const double stiffness = 1e3 * 1000 / h;
  return {ContactLaw::coulomb, stiffness, 0.1 * stiffness, friction, 0, 0, 0};
}

/// A plate on a firm ground, pressed down by 1. A crack from its left side, that rises by 0.7 in 1,
/// has nearly cut it.
CaseSpec nearly_cut(double friction, bool on_scales = false) {
  constexpr int cells = 20;
  CaseSpec spec = plate({0, 0}, {1, 1}, cells, cells);
  spec.solver.tolerance = 1e-10;
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom);
  top.traction = constant_load(0, -1);
  bottom.displacement = constant_load(0, 0);
  spec.boundaries = {top, bottom};
  add_crack(spec, {{0, 0.2}, {0.8, 0.76}});
  spec.cracks.back().contact = rough(friction, 1.0 / cells);
  if (on_scales) in_scales_of(spec, 100);
  return spec;
}

/// The same, and the crack has gone straight on to the right side.
std::unique_ptr<Model> cut(double friction, bool on_scales) {
  auto model = built(nearly_cut(friction, on_scales));
  find_equilibrium(*model, *make_solver(*model), 1.0);
  CrackRegistry registry = model->registry();
  const Vec2 tip = registry.cracks()[0].end_point(1);
  const std::vector<Increment> through{{0, 1, tip, {1, 0.9}, TipState::boundary}};
  apply_increments(through, model->touch_distance(), {1, 1}, registry);
  model->lay_cracks(std::move(registry));
  return model;
}

TEST(LoosePartParallel, SlidesOffWhereFrictionIsLessThanTheSlope) {
  for (const bool on_scales : {false, true}) {
    for (const double friction : {0.0, 0.3, 0.65}) {
      const auto model = cut(friction, on_scales);
      EXPECT_THROW(find_equilibrium(*model, *make_solver(*model), 1.0), SlidesOff) << friction;
    }
  }
}

TEST(LoosePartParallel, RestsWhereFrictionIsMore) {
  for (const bool on_scales : {false, true}) {
    for (const double friction : {0.75, 1.0}) {
      const auto model = cut(friction, on_scales);
      const Equilibrium e = find_equilibrium(*model, *make_solver(*model), 1.0);
      double pressed = 0.0;
      for (const ContactPatch& p : model->contact().patches()) pressed += p.length * p.now.normal;
      // the weight on the slope, N = cos a
      EXPECT_NEAR(pressed, -1.0 / std::hypot(1.0, 0.7), 1e-3) << friction;
      EXPECT_LT(e.strain_energy, 2 * 0.5 / 1000);
    }
  }
}

CaseSpec growing(CaseSpec spec, bool critical) {
  spec.material.toughness = 0.01;
  spec.growth.criterion = Criterion::hoop;
  spec.growth.fixed_step = true;
  spec.growth.step_length = {1.5, 1.5};
  spec.loading.critical = critical;
  spec.loading.max_events = 20;
  spec.load_factors = {0.25, 0.5, 0.75, 1.0};
  return spec;
}

Summary run(const CaseSpec& spec) {
  return run_simulation(spec, "test", world(), world_partitioner(), {});
}

TEST(LoosePartParallel, EndsARunAsSeparatedWhenItSlidesOff) {
  for (const bool critical : {false, true}) {
    const Summary s = run(growing(nearly_cut(0.5), critical));
    EXPECT_EQ(s.status, "separated");
    EXPECT_NE(s.message.find("slides off"), std::string::npos) << s.message;
    ASSERT_FALSE(s.events.empty());
    EXPECT_EQ(s.events.back().kind, "separated");
  }
}

/// A joint that loads press at first and then pull apart. Beside it, faces of a crack hardly touch
/// any more, so little that the way of the part leaves nothing of it in their gaps.
TEST(LoosePartParallel, EndsARunAsSeparatedWhenItIsPulledOff) {
  for (const double friction : {0.0, 0.3}) {
    CaseSpec spec = plate({0, 0}, {1, 2}, 10, 20);
    spec.solver.tolerance = 1e-8;
    add_crack(spec, {{0, 1.03}, {1, 1.03}});
    add_crack(spec, {{0, 0.53}, {0.3, 0.53}});
    for (CrackSpec& crack : spec.cracks) crack.contact = rough(friction, 0.1);
    BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom);
    top.traction[0] = proportional_load(0);
    top.traction[1] = {[](double, double, double s) { return 3 * s - 1; }, false, "3*s - 1"};
    bottom.displacement = constant_load(0, 0);
    spec.boundaries = {top, bottom};
    spec.load_factors = {0.2, 0.4};
    spec.material.toughness = 1.0;
    spec.growth.criterion = Criterion::hoop;
    const Summary s = run(spec);
    EXPECT_EQ(s.status, "separated");
    EXPECT_EQ(s.steps.size(), 2u);
  }
}

/// The search begins at loads under which a joint that holds by cohesion slides. Under less than a
/// third of those that it bears a flaw below grows.
TEST(LoosePartParallel, HoldsUnderTheLoadsOfTheFirstGrowth) {
  CaseSpec spec = growing(nearly_cut(0.3), true);
  spec.cracks[0].points[1] = {1, 0.9};
  spec.cracks[0].contact.cohesion = 0.5;
  spec.boundaries[0].traction = constant_load(0, -10);
  add_crack(spec, {{0.61, 0.21}, {0.82, 0.42}});
  spec.cracks.back().contact = rough(0.0, 1.0 / 20);
  spec.material.toughness = 0.2;
  spec.loading.max_events = 2;
  const Summary s = run(spec);
  EXPECT_EQ(s.status, "completed") << s.message;
  ASSERT_EQ(s.steps.size(), 2u);
  EXPECT_LT(s.steps[0].load_factor, 0.1);
  EXPECT_GT(s.steps[1].crack_length, s.steps[0].crack_length);
}

/// The search for the next growth looks at much higher loads, in vain. There the chip that has come
/// off the rim moves, but this has not happened to it.
TEST(LoosePartParallel, IsWhereItWasAfterASearchInVain) {
  CaseSpec spec = plate({0, 0}, {0.56, 1.25}, 22, 29);
  spec.solver.tolerance = 1e-8;
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom), pin = at_point({0, 0});
  top.traction = constant_load(0, -1);
  bottom.displacement[1] = proportional_load(0);
  pin.displacement[0] = proportional_load(0);
  spec.boundaries = {top, bottom, pin};
  const std::vector<std::vector<Vec2>> from_the_rim{{{0.47, 0.98}, {0.35, 0.99}},
                                                    {{0.56, 0.35}, {0.33, 0.38}},
                                                    {{0.56, 0.90}, {0.456, 0.902}},
                                                    {{0.56, 0.6262}, {0.51, 0.70}}};
  for (const auto& points : from_the_rim) {
    add_crack(spec, points);
    spec.cracks.back().contact = rough(0.5, 0.56 / 22);
  }
  spec = growing(spec, true);
  spec.growth.corrected = false;
  const Summary s = run(spec);
  EXPECT_EQ(s.status, "completed");
  EXPECT_TRUE(std::any_of(s.events.begin(), s.events.end(),
                          [](const EventRecord& e) { return e.kind == "fragment"; }));
  for (const StepRecord& step : s.steps)
    EXPECT_GE(step.dissipated - step.friction_work, -1e-9 * step.external_work) << step.step;
}

}  // namespace
}  // namespace cdca::testing
