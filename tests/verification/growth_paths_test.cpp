// SPDX-License-Identifier: BSD-3-Clause
/// Paths of growing cracks against those of tests/verification/reference/paths.json.
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace cdca::testing {
namespace {

using Json = nlohmann::json;

Json reference_paths() {
  std::ifstream file(CDCA_SOURCE_DIR "/tests/verification/reference/paths.json");
  return Json::parse(file).at("paths");
}

/// A plate under a tension at which all tips grow all the time, as those of the reference do.
struct GrowthCase {
  CaseSpec spec;
  std::vector<std::vector<Vec2>> reference;
  double tolerance = 0.0;
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
  const double angle = (id.find("beta=45") != std::string::npos ? 45 : 30) * std::acos(-1.0) / 180;
  const Vec2 half = 0.15 * Vec2(std::cos(angle), std::sin(angle));
  return {-half, half};
}

GrowthCase growth_case(const std::string& id, const Json& entry) {
  GrowthCase c{plate_for(id), {}, entry.at("path_tolerance").get<double>()};
  for (const auto& crack : entry.at("cracks")) {
    std::vector<Vec2> path;
    for (const auto& p : crack) path.emplace_back(p[0].get<double>(), p[1].get<double>());
    add_crack(c.spec, initial_crack(id, path));
    c.reference.push_back(path);
  }
  load_in_tension(c.spec);
  c.spec.growth.fixed_step = c.spec.growth.step_in_metres = true;
  const double step = c.spec.domain.size.x() / 50;
  c.spec.growth.step_length = {step, step};
  c.spec.growth.cycles = 32;
  return c;
}

double distance_to(const std::vector<Vec2>& path, const Vec2& x) {
  double nearest = 1e300;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const Vec2 foot = path[k] + nearest_fraction(path[k], path[k + 1], x) * (path[k + 1] - path[k]);
    nearest = std::min(nearest, (foot - x).norm());
  }
  return nearest;
}

class SlowGrowthPaths : public ::testing::TestWithParam<std::string> {};

TEST_P(SlowGrowthPaths, FollowTheReference) {
  const GrowthCase c = growth_case(GetParam(), reference_paths().at(GetParam()));
  const Summary run = run_simulation(c.spec, "test", world(), world_partitioner(), {});
  double farthest = 0.0;
  for (std::size_t k = 0; k < c.reference.size(); ++k) {
    for (const Vec2& x : c.reference[k])
      farthest = std::max(farthest, distance_to(run.cracks[k].points, x));
  }
  std::cout << GetParam() << ": largest distance " << farthest << ", tolerance " << c.tolerance
            << ", " << run.steps.back().growth_cycles << " cycles, " << run.status << "\n";
  EXPECT_LE(farthest, c.tolerance);
  double dissipated = 0.0;
  for (const StepRecord& step : run.steps) {
    EXPECT_GE(step.dissipated, dissipated - 1e-9 * step.external_work);
    dissipated = step.dissipated;
  }
}

std::vector<std::string> growth_paths() {
  std::vector<std::string> ids;
  const Json paths = reference_paths();
  for (const auto& [id, entry] : paths.items()) {
    if (entry.at("tag") == "growth") ids.push_back(id);
  }
  return ids;
}

std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Paths, SlowGrowthPaths, ::testing::ValuesIn(growth_paths()), test_name);

}  // namespace
}  // namespace cdca::testing
