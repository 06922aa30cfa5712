// SPDX-License-Identifier: BSD-3-Clause
/// When and where tips begin to grow, and what it costs.
#include "core/mechanics/fracture_criterion.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"
#include "tests/verification/reference_solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace cdca::testing {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::vector<ReferenceCase> cases_of_criteria() {
  std::vector<ReferenceCase> found;
  for (const ReferenceCase& c : reference_cases()) {
    if (c.tag == "criterion") found.push_back(c);
  }
  return found;
}

std::string name_of_case(const ::testing::TestParamInfo<ReferenceCase>& c) {
  return test_name(c.param);
}

class KinkAngles : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(KinkAngles, AreThoseOfTheReference) {
  const nlohmann::json& json = GetParam().json;
  const double angle_bar = json.at("tolerance").at("angle_abs_deg");
  const double value_bar = json.at("ref_accuracy");
  ASSERT_FALSE(json.at("reference").empty());
  for (const auto& row : json.at("reference")) {
    const std::string ratio = row.at("KII_over_KI");
    const bool pure_shear = ratio == "inf";
    const double k1 = pure_shear ? 0.0 : 1.0, k2 = pure_shear ? 1.0 : std::stod(ratio);
    const double angle = hoop_angle(k1, k2);
    EXPECT_NEAR(angle / degree, row.at("MTS_deg").get<double>(), angle_bar) << ratio;
    EXPECT_NEAR(hoop_intensity(k1, k2, angle), row.at("Keq_MTS").get<double>(), value_bar) << ratio;
    // Griffith's parabola on the same arc: the same angle and the same value
    const Strength strength{1.0, 1.0, std::nullopt, std::nullopt};
    const double r = 0.01;
    const auto mixed =
        judge_mixed(singular_arc(k1, k2, r), {}, std::sqrt(2 * std::numbers::pi * r), strength);
    EXPECT_NEAR(mixed.tensile_angle / degree, row.at("paper_eq19_deg").get<double>(), angle_bar)
        << ratio;
    EXPECT_NEAR(mixed.u_tension, row.at("paper_eq19_value").get<double>(), value_bar) << ratio;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, KinkAngles, ::testing::ValuesIn(cases_of_criteria()), name_of_case);

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

/// The load at which the first tip reaches its toughness in a case of the reference, K_IC = 1.
double first_growth(const ReferenceCase& reference, Criterion criterion, int n) {
  const ReferenceGeometry g = geometry_of(reference);
  CaseSpec spec = spec_of(g, load_of(reference), {g.lower, g.upper, n, n});
  spec.loading.critical = true;
  spec.loading.max_events = 1;
  spec.material.toughness = 1.0;
  // r_c = 0.04: held at 2 h on the coarse grid, at 4 h on the fine one, and free in between
  spec.material.tensile_strength = 2.0;
  spec.growth.criterion = criterion;
  return run(spec).steps.front().load_factor;
}

class FirstGrowth : public ::testing::TestWithParam<ReferenceCase> {};

/// Both criteria grow a tip where its greatest hoop stress is that of K_IC, so the load follows
/// from the K of the reference.
TEST_P(FirstGrowth, LoadIsThatOfTheToughnessOnAnyGrid) {
  double greatest = 0.0;
  for (const ExpectedTip& tip : expected_tips(GetParam())) {
    greatest = std::max(greatest, hoop_intensity(tip.k1, tip.k2, hoop_angle(tip.k1, tip.k2)));
  }
  for (const Criterion criterion : {Criterion::hoop, Criterion::mixed}) {
    double before = 0.0;
    for (const int n : {31, 62, 124}) {
      const double factor = first_growth(GetParam(), criterion, n);
      std::cout << (criterion == Criterion::hoop ? "hoop " : "mixed ") << n << ": load / K_IC's "
                << factor * greatest << "\n";
      EXPECT_NEAR(factor, 1 / greatest, 0.03 / greatest) << n;
      if (before > 0.0) {
        EXPECT_NEAR(factor, before, 0.03 * before) << n;
      }
      before = factor;
    }
  }
}

/// In mode I and in mixed mode, square plates.
std::vector<ReferenceCase> centre_cracks() {
  std::vector<ReferenceCase> found;
  for (const ReferenceCase& c : reference_cases()) {
    if (c.id == "CC_W_1_H_1_a_0.15_beta_0" || c.id == "CC_W_1_H_1_a_0.3_beta_45") {
      found.push_back(c);
    }
  }
  return found;
}

INSTANTIATE_TEST_SUITE_P(Cases, FirstGrowth, ::testing::ValuesIn(centre_cracks()), name_of_case);

TEST(FirstGrowthCases, AreThere) { EXPECT_EQ(centre_cracks().size(), 2u); }

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
