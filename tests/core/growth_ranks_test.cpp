// SPDX-License-Identifier: BSD-3-Clause
/// Growing cracks take the same way on any number of ranks.
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

namespace cdca::testing {
namespace {

/// Three cracks in tension: one meets another, one reaches the rim.
CaseSpec growing_cracks() {
  CaseSpec spec = plate({0, 0}, {1.2, 1.6}, 24, 32);
  add_crack(spec, {{0.0, 0.71}, {0.31, 0.74}});
  add_crack(spec, {{0.62, 0.83}, {0.9, 0.77}});
  add_crack(spec, {{0.47, 0.35}, {0.52, 1.1}});
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom), pin = at_point({0, 0});
  top.displacement[1] = proportional_load(4e-3);
  bottom.displacement[1] = proportional_load(0);
  pin.displacement[0] = proportional_load(0);
  spec.boundaries = {top, bottom, pin};
  spec.solver.tolerance = 1e-11;
  spec.load_factors = {0.25, 0.5, 0.75, 1.0};
  spec.material.toughness = 1.0;
  spec.growth.criterion = Criterion::hoop;
  spec.growth.fixed_step = true;
  spec.growth.step_length = {1.5, 1.5};
  return spec;
}

TEST(GrowthParallel, SameEventsPathsAndIntensities) {
  const CaseSpec spec = growing_cracks();
  SerialCommunicator alone;
  const Partitioner one_part = [](const PartitionGraph& graph, int) {
    return std::vector<int>(graph.weights.size(), 0);
  };
  const Summary one = run_simulation(spec, "test", alone, one_part, {});
  const Summary many = run_simulation(spec, "test", world(), world_partitioner(), {});
  constexpr double h = 0.05;
  EXPECT_EQ(one.status, many.status);
  ASSERT_EQ(one.steps.size(), many.steps.size());
  EXPECT_GT(one.steps.back().crack_length, one.steps.front().crack_length + 2 * h);
  ASSERT_EQ(one.events.size(), many.events.size());
  for (std::size_t e = 0; e < one.events.size(); ++e) {
    EXPECT_EQ(one.events[e].kind, many.events[e].kind);
    EXPECT_EQ(one.events[e].crack, many.events[e].crack);
    EXPECT_EQ(one.events[e].step, many.events[e].step);
  }
  for (std::size_t c = 0; c < one.cracks.size(); ++c) {
    ASSERT_EQ(one.cracks[c].points.size(), many.cracks[c].points.size());
    for (std::size_t k = 0; k < one.cracks[c].points.size(); ++k) {
      EXPECT_LT((one.cracks[c].points[k] - many.cracks[c].points[k]).norm(), 1e-4 * h);
    }
  }
  for (std::size_t t = 0; t < one.tips.size(); ++t) {
    EXPECT_EQ(one.tips[t].state, many.tips[t].state);
    EXPECT_NEAR(one.tips[t].k1, many.tips[t].k1, 1e-6);
    EXPECT_NEAR(one.tips[t].k2, many.tips[t].k2, 1e-6);
  }
}

}  // namespace
}  // namespace cdca::testing
