// SPDX-License-Identifier: BSD-3-Clause
/// Paths of growing cracks against those of tests/verification/reference/paths.json: every path
/// tagged "growth", its beginning on a coarse grid in every test run, all of it in the slow suite.
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"
#include "tests/verification/path_comparison.hpp"
#include "tests/verification/reference_cases.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace cdca::testing {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A plate under a tension at which all tips grow all the time, as those of the reference do.
struct GrowthCase {
  CaseSpec spec;
  std::vector<std::vector<Vec2>> reference;
  double tolerance = 0.0;
  double step = 0.0;  ///< m
};

void load_in_tension(CaseSpec& spec) {
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom);
  top.traction = constant_load(0, 1);
  bottom.traction = constant_load(0, -1);
  BoundarySpec pin = at_point(spec.domain.origin), roller = pin;
  pin.displacement = constant_load(0, 0);
  roller.at += Vec2(spec.domain.size.x(), 0);
  roller.displacement[1] = proportional_load(0);
  spec.boundaries = {top, bottom, pin, roller};
  spec.solver.tolerance = 1e-8;
  spec.load_factors = {3.0};
  spec.material.toughness = 1.0;
  spec.growth.criterion = Criterion::hoop;
}

CaseSpec plate_for(const std::string& id) {
  if (id.find("SLANT W=1 H=2") == 0) return plate({-0.5, -1}, {0.5, 1}, 61, 121);
  if (id.find("EDGES 40x40") == 0) return plate({-20, -20}, {20, 20}, 81, 81);
  if (id.find("EDGES 60x120") == 0) return plate({-30, -60}, {30, 60}, 61, 121);
  ADD_FAILURE() << "no plate is known for the path \"" << id << "\"";
  return plate({0, 0}, {1, 1}, 1, 1);
}

/// The initial crack within a reference path, which lists the grown one.
std::vector<Vec2> initial_crack(const std::string& id, const std::vector<Vec2>& path) {
  if (id.find("SLANT") != 0) return {path[0], path[1]};
  const double angle = (id.find("beta=45") != std::string::npos ? 45 : 30) * degree;
  const Vec2 half = 0.15 * Vec2(std::cos(angle), std::sin(angle));
  return {-half, half};
}

/// Steps of 1/50 of the width, as the reference asks for (1/40 to 1/80).
GrowthCase growth_case(const ReferenceCase& reference) {
  const std::string& id = reference.id;
  GrowthCase c{plate_for(id), {}, reference.json.at("path_tolerance").get<double>()};
  for (const auto& crack : reference.json.at("cracks")) {
    std::vector<Vec2> path;
    for (const auto& p : crack) path.emplace_back(p[0].get<double>(), p[1].get<double>());
    add_crack(c.spec, initial_crack(id, path));
    c.reference.push_back(path);
  }
  load_in_tension(c.spec);
  c.step = c.spec.domain.size.x() / 50;
  c.spec.growth.fixed_step = c.spec.growth.step_in_metres = true;
  c.spec.growth.step_length = {c.step, c.step};
  c.spec.growth.cycles = 32;
  return c;
}

Summary grown(const CaseSpec& spec) {
  return run_simulation(spec, "test", world(), world_partitioner(), {});
}

/// Crack and end of "(0, 1)".
std::pair<int, int> tip_of(const std::string& key) { return {key.at(1) - '0', key.at(4) - '0'}; }

/// The first increment must leave the initial crack under the angle of the reference, within 3
/// degrees: it says so for every tip that grows.
void expect_first_kinks(const ReferenceCase& reference, const GrowthCase& c, const Summary& run) {
  for (const auto& [key, angle] : reference.json.at("mts0").items()) {
    const auto [crack, end] = tip_of(key);
    const auto kink = first_kink(c.spec.cracks.at(std::size_t(crack)).points,
                                 run.cracks.at(std::size_t(crack)).points, end);
    ASSERT_TRUE(kink) << "tip " << key << " did not grow";
    EXPECT_NEAR(*kink, angle.get<double>(), 3.0) << "tip " << key;
  }
}

std::vector<ReferenceCase> growth_paths() {
  std::vector<ReferenceCase> paths;
  for (const ReferenceCase& c : reference_cases()) {
    if (c.tag == "growth") paths.push_back(c);
  }
  return paths;
}

std::string name_of_path(const ::testing::TestParamInfo<ReferenceCase>& c) {
  return test_name(c.param);
}

/// The listed points of the reference lie on the path of the program.
class SlowGrowthPaths : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(SlowGrowthPaths, FollowTheReference) {
  const GrowthCase c = growth_case(GetParam());
  const Summary run = grown(c.spec);
  double distance = 0.0;
  for (std::size_t k = 0; k < c.reference.size(); ++k) {
    distance = std::max(distance, farthest(c.reference[k], run.cracks[k].points));
  }
  std::cout << GetParam().id << ": largest distance " << distance << ", tolerance " << c.tolerance
            << ", " << run.steps.back().growth_cycles << " cycles, " << run.status << "\n";
  EXPECT_LE(distance, c.tolerance);
  expect_first_kinks(GetParam(), c, run);
  double dissipated = 0.0;
  for (const StepRecord& step : run.steps) {
    EXPECT_GE(step.dissipated, dissipated - 1e-9 * step.external_work);
    dissipated = step.dissipated;
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, SlowGrowthPaths, ::testing::ValuesIn(growth_paths()), name_of_path);

/// Elements twice as large, and the first six steps: the points that the tips reach lie on the
/// reference.
class GrowthPaths : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(GrowthPaths, BeginLikeTheReference) {
  GrowthCase c = growth_case(GetParam());
  for (int& cells : c.spec.domain.cells) cells = (cells + 1) / 2;
  c.spec.growth.cycles = 6;
  const Summary run = grown(c.spec);
  double distance = 0.0, before = 0.0;
  for (std::size_t k = 0; k < c.reference.size(); ++k) {
    distance = std::max(distance, farthest(run.cracks[k].points, c.reference[k]));
    before += (c.spec.cracks[k].points[1] - c.spec.cracks[k].points[0]).norm();
  }
  std::cout << GetParam().id << ": largest distance " << distance << ", tolerance " << c.tolerance
            << "\n";
  EXPECT_LE(distance, c.tolerance);
  EXPECT_NEAR(run.steps.back().crack_length - before, 12 * c.step, 1e-3 * c.step);  // two tips
  expect_first_kinks(GetParam(), c, run);
}

INSTANTIATE_TEST_SUITE_P(Paths, GrowthPaths, ::testing::ValuesIn(growth_paths()), name_of_path);

/// In critical mode only the tips grow that reach their toughness first: in a body with a centre of
/// symmetry that is always both, by whatever angle the crack lies in the grid.
class CriticalGrowth : public ::testing::TestWithParam<int> {};

TEST_P(CriticalGrowth, OfASlantedCrackIsSymmetric) {
  CaseSpec spec = plate({-0.5, -1}, {0.5, 1}, 41, 81);
  const double angle = GetParam() * degree;
  const Vec2 half = 0.15 * Vec2(std::cos(angle), std::sin(angle));
  add_crack(spec, {-half, half});
  load_in_tension(spec);
  spec.solver.tolerance = 1e-11;  // the rule for mirrored problems
  spec.loading.critical = true;
  spec.loading.max_events = 10;
  spec.growth.fixed_step = spec.growth.step_in_metres = true;
  spec.growth.step_length = {0.02, 0.02};
  const Summary run = grown(spec);
  const auto& path = run.cracks.at(0).points;
  ASSERT_EQ(run.steps.size(), 10u);
  ASSERT_EQ(path.size(), 2u + 2 * 9) << "not both tips grew in every cycle";
  for (std::size_t k = 0; k < path.size(); ++k) {
    EXPECT_LT((path[k] + path[path.size() - 1 - k]).norm(), 1e-4 / 41) << "point " << k;
  }
  EXPECT_NEAR(run.tips[0].k1, run.tips[1].k1, 1e-6);
  EXPECT_NEAR(run.tips[0].k2, run.tips[1].k2, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Angles, CriticalGrowth, ::testing::Values(0, 30, 45, 63));

/// The same on the grid of the reference paths, where both tips follow the reference.
TEST(SlowCriticalGrowth, FollowsTheReferenceOfSlant45) {
  for (const ReferenceCase& reference : growth_paths()) {
    if (reference.id != "SLANT W=1 H=2 a=.15 beta=45") continue;
    GrowthCase c = growth_case(reference);
    c.spec.solver.tolerance = 1e-11;
    c.spec.loading.critical = true;
    c.spec.loading.max_events = 13;  // 12 steps: not beyond the end of the reference
    const Summary run = grown(c.spec);
    const double distance = farthest(run.cracks.at(0).points, c.reference.at(0));
    std::cout << "critical: largest distance " << distance << ", tolerance " << c.tolerance << "\n";
    EXPECT_LE(distance, c.tolerance);
    EXPECT_EQ(run.cracks.at(0).points.size(), 2u + 2 * 12) << "not both tips grew in every cycle";
    return;
  }
  FAIL() << "the path is not in paths.json";
}

}  // namespace
}  // namespace cdca::testing
