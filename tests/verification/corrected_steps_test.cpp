// SPDX-License-Identifier: BSD-3-Clause
/// Steps of growth whose direction is corrected: what was found on trial is where the equilibrium
/// after the step is sought from.
#include "core/simulation/growth.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

namespace cdca::testing {
namespace {

/// A flaw of 24 elements at 45 degrees with wings of two elements, in compression. Its faces slide
/// without friction, so that there is one equilibrium.
CaseSpec winged_flaw() {
  constexpr int cells = 60;
  constexpr double h = 1.0 / cells;
  CaseSpec spec = plate({0, 0}, {1, 1}, cells, cells);
  spec.solver.tolerance = 1e-11;
  pull(spec, {0, -1, 0});
  const Vec2 half = 12 * h / std::numbers::sqrt2 * Vec2(1, 1), wing(-0.8 * h, 1.8 * h);
  const Vec2 middle(0.503, 0.497);
  add_crack(spec, {middle - half - wing, middle - half, middle + half, middle + half + wing});
  spec.cracks.back().contact = {ContactLaw::frictionless, 1e3 * 1000 / h, 0, 0, 0, 0, 0};
  in_scales_of(spec, 300);
  return spec;
}

std::vector<GrowthPlan> plans_of(const CaseSpec& spec) {
  const double length = 1.5 * spec.domain.size.x() / spec.domain.cells[0];
  return {{0, 0, 0.1, length, true}, {0, 1, 0.1, length, true}};
}

/// The equilibrium after a corrected step: from the trial, or from before the step.
Solved grown(bool from_trial) {
  const CaseSpec spec = winged_flaw();
  Solved s = solved(spec);
  Model& model = *s.model;
  const auto solver = make_solver(model);
  std::vector<GrowthPlan> plans = plans_of(spec);
  const auto trial = correct_directions(model, *solver, 1.0, {1, 1}, plans);
  EXPECT_TRUE(trial.has_value());
  EXPECT_NE(plans[0].angle, plans_of(spec)[0].angle) << "a way that was off is corrected";
  CrackRegistry registry = model.registry();
  apply_increments(increments_of(model, registry, plans), model.touch_distance(), {1, 0}, registry);
  model.lay_cracks(std::move(registry));
  if (from_trial && trial) model.start_from(*trial);
  s.equilibrium = find_equilibrium(model, *solver, 1.0);
  return s;
}

TEST(CorrectedStep, EndsWhereItsTrialBeganFromOnlySooner) {
  const Solved near = grown(true), far = grown(false);
  const Equilibrium &a = near.equilibrium, &b = far.equilibrium;
  EXPECT_NEAR(a.strain_energy, b.strain_energy, 1e-9 * b.strain_energy);
  double largest = 0.0, off = 0.0;
  ASSERT_EQ(near.model->state().size(), far.model->state().size());
  for (std::size_t k = 0; k < near.model->state().size(); ++k) {
    largest = std::max(largest, std::abs(far.model->state()[k]));
    off = std::max(off, std::abs(near.model->state()[k] - far.model->state()[k]));
  }
  EXPECT_LE(off, 1e-7 * largest);
  std::cout << a.contact_iterations << " instead of " << b.contact_iterations << " iterations\n";
  EXPECT_LT(a.contact_iterations, b.contact_iterations);
}

/// The model is as it was, whatever was tried.
TEST(CorrectedStep, LeavesTheModelAsItWas) {
  const CaseSpec spec = winged_flaw();
  const Solved s = solved(spec);
  Model& model = *s.model;
  const std::vector<double> state = model.state();
  std::vector<GrowthPlan> plans = plans_of(spec);
  correct_directions(model, *make_solver(model), 1.0, {1, 1}, plans);
  EXPECT_EQ(model.state(), state);
  model.build_stiffness();
  const Equilibrium again = find_equilibrium(model, *make_solver(model), 1.0);
  EXPECT_NEAR(again.strain_energy, s.equilibrium.strain_energy,
              1e-10 * s.equilibrium.strain_energy);
  EXPECT_LE(again.contact_iterations, 1);
}

}  // namespace
}  // namespace cdca::testing
