// SPDX-License-Identifier: BSD-3-Clause
/// Joining cracks, their junctions and the fragments they cut off on any number of ranks, with
/// rank borders through all of them.
#include "core/cracks/random_cracks.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cdca::testing {
namespace {

constexpr int nx = 24, ny = 32;
constexpr double h = 0.05;

CaseSpec in_tension(const std::vector<std::vector<Vec2>>& cracks) {
  CaseSpec spec = plate({0, 0}, {1.2, 1.6}, nx, ny);
  for (const auto& points : cracks) add_crack(spec, points);
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom), pin = at_point({1.2, 0});
  top.displacement[1] = proportional_load(4e-3);
  bottom.displacement[1] = proportional_load(0);
  pin.displacement[0] = proportional_load(0);
  spec.boundaries = {top, bottom, pin};
  spec.solver.tolerance = 1e-11;
  spec.material.toughness = 1.0;
  spec.growth.criterion = Criterion::hoop;
  spec.growth.fixed_step = true;
  spec.growth.step_length = {1.5, 1.5};
  spec.growth.corrected = false;  // fewer solves
  spec.load_factors = {0.4, 0.6};
  return spec;
}

/// Two notches that grow from the rims to a vertical crack each and cut off the blocks in two
/// corners, the longer one first. The supports leave the blocks free to slide along their sides.
CaseSpec two_blocks() {
  return in_tension({{{0.41, 0.0}, {0.41, 0.5}},
                     {{0.0, 0.34}, {0.27, 0.35}},
                     {{0.83, 1.6}, {0.83, 1.1}},
                     {{1.2, 1.26}, {1.05, 1.27}}});
}

/// Cells dealt out so that every few of them have another owner.
Partitioner scattered(int shift) {
  return [shift](const PartitionGraph& graph, int parts) {
    std::vector<int> owner;
    for (int k = 0; k < int(graph.weights.size()); ++k) {
      const int i = k % (nx + 1) + shift, j = k / (nx + 1) + shift;
      owner.push_back((i / 3 + 2 * (j / 4)) % parts);
    }
    return owner;
  };
}

Summary alone(const CaseSpec& spec) {
  SerialCommunicator serial;
  return run_simulation(spec, "test", serial, scattered(0), {});
}

Summary together(const CaseSpec& spec, const Partitioner& partitioner) {
  return run_simulation(spec, "test", world(), partitioner, {});
}

void expect_same(const Summary& one, const Summary& many) {
  EXPECT_EQ(one.status, many.status);
  ASSERT_EQ(one.events.size(), many.events.size());
  for (std::size_t e = 0; e < one.events.size(); ++e) {
    const EventRecord &a = one.events[e], &b = many.events[e];
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.cycle, b.cycle);
    EXPECT_EQ(a.crack, b.crack);
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.partner, b.partner);
    EXPECT_LT((a.at - b.at).norm(), 1e-4 * h) << a.kind;
  }
  for (std::size_t c = 0; c < one.cracks.size(); ++c) {
    ASSERT_EQ(one.cracks[c].points.size(), many.cracks[c].points.size());
    for (std::size_t k = 0; k < one.cracks[c].points.size(); ++k)
      EXPECT_LT((one.cracks[c].points[k] - many.cracks[c].points[k]).norm(), 1e-4 * h);
  }
  for (std::size_t t = 0; t < one.tips.size(); ++t) {
    EXPECT_EQ(one.tips[t].state, many.tips[t].state);
    EXPECT_NEAR(one.tips[t].k1, many.tips[t].k1, 1e-6);
    EXPECT_NEAR(one.tips[t].k2, many.tips[t].k2, 1e-6);
  }
}

std::vector<EventRecord> events_of(const Summary& s, const std::string& kind) {
  std::vector<EventRecord> found;
  std::copy_if(s.events.begin(), s.events.end(), std::back_inserter(found),
               [&](const EventRecord& e) { return e.kind == kind; });
  return found;
}

TEST(JoiningParallel, FragmentsAreNotedOnceEachAndAlike) {
  const Summary one = alone(two_blocks());
  const auto fragments = events_of(one, "fragment");
  ASSERT_EQ(fragments.size(), 2u) << "one for every block, and no other in later cycles";
  EXPECT_LT(fragments[0].at.x(), 0.41);
  EXPECT_LT(fragments[0].at.y(), 0.35);
  EXPECT_GT(fragments[1].at.x(), 0.83);
  EXPECT_GT(fragments[1].at.y(), 1.26);
  EXPECT_LT(fragments[0].step, fragments[1].step);
  EXPECT_EQ(events_of(one, "coalescence").size(), 2u);
  EXPECT_EQ(one.status, "completed") << "the body between the blocks still carries";
  expect_same(one, together(two_blocks(), world_partitioner()));
  expect_same(one, together(two_blocks(), scattered(1)));
}

/// Random cracks that grow into each other.
TEST(JoiningParallel, ANetworkGrowsAlike) {
  CrackFieldSpec field{18, {0.15, 0.3}, {0, 180}, {Vec2(0.05, 0.05), Vec2(1.15, 1.55)}, 3};
  std::vector<std::vector<Vec2>> cracks;
  for (const auto& ends : random_cracks(field)) cracks.push_back({ends[0], ends[1]});
  CaseSpec spec = in_tension(cracks);
  spec.load_factors = {2.0};
  spec.growth.step_length = {2.5, 2.5};
  spec.growth.cycles = 5;
  const Summary one = alone(spec);
  EXPECT_GE(events_of(one, "coalescence").size() + events_of(one, "connection").size(), 4u);
  expect_same(one, together(spec, scattered(2)));
}

}  // namespace
}  // namespace cdca::testing
