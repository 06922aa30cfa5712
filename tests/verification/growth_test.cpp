// SPDX-License-Identifier: BSD-3-Clause
/// When and where tips begin to grow, and what it costs.
#include "core/mechanics/fracture_criterion.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <numbers>

namespace cdca::testing {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(KinkAngles, AreThoseOfTheReference) {
  std::ifstream file(CDCA_SOURCE_DIR "/tests/verification/reference/cases.json");
  int compared = 0;
  const auto cases = nlohmann::json::parse(file);
  for (const auto& entry : cases.at("cases")) {
    if (entry.at("id") != "KINK_ANGLES") continue;
    for (const auto& row : entry.at("reference")) {
      const std::string ratio = row.at("KII_over_KI");
      const bool pure_shear = ratio == "inf";
      const double k1 = pure_shear ? 0.0 : 1.0, k2 = pure_shear ? 1.0 : std::stod(ratio);
      const double angle = hoop_angle(k1, k2);
      EXPECT_NEAR(angle / degree, row.at("MTS_deg").get<double>(), 0.05) << ratio;
      EXPECT_NEAR(hoop_intensity(k1, k2, angle), row.at("Keq_MTS").get<double>(), 1e-4) << ratio;
      // Griffith's parabola on the same arc: the same angle and the same value
      const Strength strength{1.0, 1.0, std::nullopt, std::nullopt};
      const double r = 0.01;
      const auto mixed =
          judge_mixed(singular_arc(k1, k2, r), {}, std::sqrt(2 * std::numbers::pi * r), strength);
      EXPECT_NEAR(mixed.angle / degree, row.at("paper_eq19_deg").get<double>(), 0.05) << ratio;
      EXPECT_NEAR(mixed.u_tension, row.at("paper_eq19_value").get<double>(), 1e-3) << ratio;
      ++compared;
    }
  }
  EXPECT_GE(compared, 8);
}

/// A centre crack in tension, slanted by `angle`, growing at K_IC = 1.
CaseSpec slanted(double angle, int n) {
  CaseSpec spec = plate({-1, -1}, {1, 1}, n, n);
  const Vec2 half = 0.3 * Vec2(std::cos(angle), std::sin(angle));
  add_crack(spec, {-half, half});
  pull(spec, Voigt(0, 1, 0));
  spec.solver.tolerance = 1e-10;
  spec.loading.critical = true;
  spec.loading.max_events = 1;
  spec.material.toughness = 1.0;
  spec.material.tensile_strength = 2.0;
  spec.growth.criterion = Criterion::hoop;
  spec.growth.fixed_step = true;
  spec.growth.step_length = {1.5, 1.5};
  return spec;
}

Summary run(const CaseSpec& spec) {
  return run_simulation(spec, "test", world(), world_partitioner(), {});
}

TEST(FirstGrowth, LoadDoesNotDependOnTheGridNorOnTheCriterion) {
  std::vector<double> factors;
  for (const Criterion criterion : {Criterion::hoop, Criterion::mixed}) {
    for (const int n : {31, 62, 124}) {
      CaseSpec spec = slanted(0.0, n);
      spec.growth.criterion = criterion;
      const Summary s = run(spec);
      factors.push_back(s.steps.front().load_factor);
      // one tip at least is at its toughness
      EXPECT_NEAR(std::max(s.tips[0].k1, s.tips[1].k1), 1.0, 1e-6);
    }
  }
  for (const double f : factors) EXPECT_NEAR(f, factors[2], 0.03 * factors[2]);
}

TEST(Growth, CostsTheToughness) {
  CaseSpec spec = slanted(0.5, 61);
  spec.loading.max_events = 9;
  const Summary s = run(spec);
  ASSERT_EQ(s.steps.size(), 9u);
  const double modulus = 1000.0 / (1 - 0.3 * 0.3);  // plane strain
  const StepRecord &first = s.steps[1], &last = s.steps.back();
  const double energy =
      (last.dissipated - first.dissipated) / (last.crack_length - first.crack_length);
  EXPECT_NEAR(energy, 1.0 / modulus, 0.03 / modulus);
}

TEST(Growth, MirroredCracksGrowMirrored) {
  CaseSpec spec = slanted(0.5, 41), mirrored = slanted(-0.5, 41);
  spec.loading.max_events = mirrored.loading.max_events = 4;
  const Summary one = run(spec), two = run(mirrored);
  ASSERT_EQ(one.cracks[0].points.size(), two.cracks[0].points.size());
  for (std::size_t k = 0; k < one.cracks[0].points.size(); ++k) {
    EXPECT_NEAR(one.cracks[0].points[k].x(), two.cracks[0].points[k].x(), 1e-5);
    EXPECT_NEAR(one.cracks[0].points[k].y(), -two.cracks[0].points[k].y(), 1e-5);
  }
}

TEST(Growth, TipsReachTheRimAndSeparateThePlate) {
  CaseSpec spec = slanted(0.0, 31);
  spec.solver.tolerance = 1e-8;  // at 1e-10 the solve of the last ligament stops at 1.3e-10
  spec.loading.max_events = 40;
  spec.loading.min_factor = 1e-6;  // to the very end
  // a side counts as loaded even where its traction is zero: only top and bottom shall
  spec.boundaries.erase(spec.boundaries.begin(), spec.boundaries.begin() + 2);
  const Summary s = run(spec);
  EXPECT_EQ(s.status, "separated");
  for (const TipRecord& tip : s.tips) EXPECT_EQ(tip.state, "boundary");
  EXPECT_TRUE(s.network.spans_x);
}

TEST(Growth, StopsAtTheFaceOfAnotherCrack) {
  CaseSpec spec = slanted(0.0, 41);
  add_crack(spec, {{0.62, -0.4}, {0.62, 0.4}});
  spec.loading.max_events = 12;
  const Summary s = run(spec);
  EXPECT_EQ(s.tips[1].state, "coalesced");
  EXPECT_NEAR(s.tips[1].at.x(), 0.62, 1e-9);
  EXPECT_EQ(s.tips[1].partner, 1);
  EXPECT_EQ(std::count_if(s.events.begin(), s.events.end(),
                          [](const EventRecord& e) { return e.kind == "coalescence"; }),
            1);
}

TEST(Growth, PrescribedLoadsGrowUntilNothingDoes) {
  CaseSpec spec = slanted(0.4, 41);
  spec.loading.critical = false;
  const double start = run(slanted(0.4, 41)).steps.front().load_factor;
  spec.boundaries.clear();  // displacement control: growth is stable
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom), pin = at_point({-1, -1});
  top.displacement[1] = proportional_load(1.3 * start / 1000.0);
  bottom.displacement[1] = proportional_load(0);
  pin.displacement[0] = proportional_load(0);
  spec.boundaries = {top, bottom, pin};
  spec.load_factors = {0.5, 1.0, 1.5, 2.0};
  const Summary s = run(spec);
  ASSERT_EQ(s.steps.size(), 4u);
  EXPECT_GT(s.steps.back().crack_length, s.steps.front().crack_length);
  double dissipated = 0.0;
  for (const StepRecord& step : s.steps) {
    EXPECT_GE(step.dissipated, dissipated - 1e-9 * step.external_work);
    EXPECT_NEAR(step.external_work, step.strain_energy + step.dissipated,
                1e-9 * step.external_work);
    dissipated = step.dissipated;
  }
  for (const TipRecord& tip : s.tips) {
    EXPECT_TRUE(tip.state != "active" || tip.u_tension < 1.0);
  }
}

}  // namespace
}  // namespace cdca::testing
