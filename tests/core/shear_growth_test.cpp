// SPDX-License-Identifier: BSD-3-Clause
/// Tips that grow in shear: pressed faces slide, and the material gives way by Mohr-Coulomb before
/// it does in tension.
#include "core/mechanics/fracture_criterion.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cdca::testing {
namespace {

constexpr double cohesion = 0.5, h = 2.0 / 41;

/// A flaw along the shear, in a plate pressed from all sides whose strength in tension is high.
CaseSpec pressed_and_sheared() {
  CaseSpec spec = plate({-1, -1}, {1, 1}, 41, 41);
  add_crack(spec, {{-0.303, 0}, {0.303, 0}});
  spec.cracks[0].contact = {ContactLaw::coulomb, 1e6, 1e6, 0.1, 0.0, 0.0, 0.0};
  pull(spec, {-2, -2, 1});
  spec.solver.tolerance = 1e-10;
  spec.material.tensile_strength = 50.0;
  spec.material.toughness = 50.0;
  spec.material.cohesion = cohesion;
  spec.material.friction_angle = 10.0;
  spec.growth.criterion = Criterion::mixed;
  spec.growth.radius = 3 * h;
  spec.growth.fixed_step = true;
  spec.growth.step_length = {1.5, 1.5};
  return spec;
}

/// Collects the rows of tips.csv.
class Rows final : public Observer {
 public:
  void on_step(const StepView& view) override {
    rows.insert(rows.end(), view.cycle_tips.begin(), view.cycle_tips.end());
  }
  std::vector<TipRecord> rows;
};

Summary run(const CaseSpec& spec, Rows& rows) {
  const std::array<Observer*, 1> observers{&rows};
  return run_simulation(spec, "test", world(), world_partitioner(), observers);
}

/// Every increment is one of shear, and both ends run straight on, along the greatest shear.
void expect_growth_in_shear(const Summary& summary, const std::vector<TipRecord>& rows,
                            std::size_t increments) {
  std::size_t grown = 0;
  for (const TipRecord& tip : rows) {
    if (!(tip.growth > 0.0)) continue;
    ++grown;
    EXPECT_EQ(tip.mode, "shear");
    EXPECT_GE(tip.u_shear, growing_index);
    EXPECT_LT(tip.u_tension, 0.5);
    EXPECT_NEAR(tip.growth, 1.5 * h, 1e-9);
    EXPECT_NEAR(tip.angle_deg, 0.0, 10.0);
  }
  EXPECT_EQ(grown, increments);
  EXPECT_NEAR(summary.steps.back().crack_length - summary.steps.front().crack_length,
              1.5 * h * double(increments), 1e-6);
}

TEST(ShearGrowthParallel, OfCriticalLoadsGrowsAtEveryEvent) {
  CaseSpec spec = pressed_and_sheared();
  spec.loading.critical = true;
  spec.loading.max_events = 4;
  Rows rows;
  const Summary summary = run(spec, rows);
  EXPECT_EQ(summary.status, "completed");
  ASSERT_EQ(summary.steps.size(), 4u);
  expect_growth_in_shear(summary, rows.rows, 6);
  for (std::size_t k = 1; k < 4; ++k)
    EXPECT_GT(summary.steps[k].crack_length, summary.steps[k - 1].crack_length);
}

TEST(ShearGrowthParallel, OfGivenLoadsGoesOnUntilItIsTooFar) {
  CaseSpec critical = pressed_and_sheared();
  critical.loading.critical = true;
  critical.loading.max_events = 1;
  Rows rows;
  const double first = run(critical, rows).steps.front().load_factor;
  CaseSpec spec = pressed_and_sheared();
  spec.load_factors = {0.99 * first, 1.01 * first};
  spec.growth.cycles = 3;
  rows.rows.clear();
  const Summary summary = run(spec, rows);
  ASSERT_EQ(summary.steps.size(), 2u);
  EXPECT_EQ(summary.steps[0].growth_cycles, 0);
  EXPECT_EQ(summary.steps[1].growth_cycles, 3);
  expect_growth_in_shear(summary, rows.rows, 6);
}

/// Where both indices tell it to grow it grows in tension.
TEST(ShearGrowth, GivesWayToTension) {
  TipJudgement j;
  j.u_tension = j.u_shear = 1.0;
  j.tensile_angle = 1.0;
  j.shear_angle = -1.0;
  j.tensile_mode = FractureMode::mixed;
  EXPECT_TRUE(j.grows() && !j.in_shear());
  EXPECT_EQ(j.angle(), 1.0);
  j.u_tension = 0.9;
  EXPECT_TRUE(j.grows() && j.in_shear());
  EXPECT_EQ(j.mode(), FractureMode::shear);
  EXPECT_EQ(j.angle(), -1.0);
  j.u_shear = 0.99;
  EXPECT_FALSE(j.grows());
  EXPECT_EQ(j.mode(), FractureMode::mixed);
}

}  // namespace
}  // namespace cdca::testing
