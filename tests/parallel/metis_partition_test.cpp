// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/metis_partition.hpp"

#include "core/base/errors.hpp"
#include "tests/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace cdca {
namespace {

/// A grid of nx by ny vertices, each joined to the next in x and y.
PartitionGraph grid_graph(int nx, int ny) {
  PartitionGraph graph;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const auto add = [&](int a, int b) {
        if (a >= 0 && a < nx && b >= 0 && b < ny) graph.neighbours.push_back(b * nx + a);
      };
      add(i, j - 1);
      add(i - 1, j);
      add(i + 1, j);
      add(i, j + 1);
      graph.offsets.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
      graph.weights.push_back(2);
    }
  return graph;
}

std::vector<std::int64_t> weight_of_parts(const PartitionGraph& graph, const std::vector<int>& part,
                                          int parts) {
  std::vector<std::int64_t> weights(static_cast<std::size_t>(parts), 0);
  for (std::size_t v = 0; v < part.size(); ++v)
    weights.at(static_cast<std::size_t>(part[v])) += graph.weights[v];
  return weights;
}

std::int64_t edges_cut(const PartitionGraph& graph, const std::vector<int>& part) {
  std::int64_t cut = 0;
  for (std::size_t v = 0; v < part.size(); ++v)
    for (auto e = graph.offsets[v]; e < graph.offsets[v + 1]; ++e)
      cut +=
          part[v] != part[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(e)])];
  return cut / 2;
}

bool all_within(const std::vector<int>& part, int parts) {
  return std::all_of(part.begin(), part.end(), [&](int p) { return p >= 0 && p < parts; });
}

TEST(MetisPartition, OnePartTakesAll) {
  EXPECT_EQ(metis_partition(grid_graph(4, 3), 1), std::vector<int>(12, 0));
}

TEST(MetisPartition, EmptyGraphHasNoParts) {
  for (const int parts : {1, 2, 7}) EXPECT_TRUE(metis_partition({}, parts).empty());
}

TEST(MetisPartition, MorePartsThanVertices) {
  const auto graph = grid_graph(3, 1);
  for (const int parts : {3, 4, 50}) {
    auto part = metis_partition(graph, parts);
    ASSERT_EQ(part.size(), 3u);
    EXPECT_TRUE(all_within(part, parts));
    std::sort(part.begin(), part.end());
    EXPECT_EQ(std::unique(part.begin(), part.end()), part.end()) << "no part needs two vertices";
  }
}

TEST(MetisPartition, BalancesAGridWithShortBorders) {
  const auto graph = grid_graph(60, 40);
  for (const int parts : {2, 3, 4, 16}) {
    const auto part = metis_partition(graph, parts);
    ASSERT_EQ(part.size(), 2400u);
    ASSERT_TRUE(all_within(part, parts));
    const auto weights = weight_of_parts(graph, part, parts);
    const double fair = 2.0 * 2400.0 / parts;
    EXPECT_LT(static_cast<double>(*std::max_element(weights.begin(), weights.end())), 1.06 * fair);
    EXPECT_GT(*std::min_element(weights.begin(), weights.end()), 0);
    // Strips across the long side would cut 40 (parts - 1) edges; no sharing out at all, 2300.
    EXPECT_LE(edges_cut(graph, part), 50 * (parts - 1));
  }
}

TEST(MetisPartition, SharesWeightsNotVertices) {
  auto graph = grid_graph(40, 10);
  for (std::size_t v = 0; v < graph.weights.size(); ++v)
    graph.weights[v] = v % 40 < 4 ? 36 : 4;  // a tenth of the vertices holds half of the weight
  const auto part = metis_partition(graph, 2);
  const auto weights = weight_of_parts(graph, part, 2);
  EXPECT_NEAR(static_cast<double>(weights[0]) / static_cast<double>(weights[0] + weights[1]), 0.5,
              0.03);
}

TEST(MetisPartition, AnswersTheSameEveryTime) {
  const auto graph = grid_graph(50, 30);
  const auto first = metis_partition(graph, 5);
  (void)metis_partition(grid_graph(17, 9), 3);  // another call in between leaves no trace
  EXPECT_EQ(metis_partition(graph, 5), first);
}

TEST(MetisPartition, TakesWeightsThatAreZeroHugeOrLeftOut) {
  auto graph = grid_graph(20, 20);
  std::fill(graph.weights.begin(), graph.weights.end(), 0);
  auto part = metis_partition(graph, 2);
  EXPECT_NEAR(static_cast<double>(std::count(part.begin(), part.end(), 0)), 200.0, 12.0);
  std::fill(graph.weights.begin(), graph.weights.end(), std::numeric_limits<std::int32_t>::max());
  part = metis_partition(graph, 2);
  EXPECT_NEAR(static_cast<double>(std::count(part.begin(), part.end(), 0)), 200.0, 12.0);
  graph.weights.clear();
  part = metis_partition(graph, 2);
  EXPECT_NEAR(static_cast<double>(std::count(part.begin(), part.end(), 0)), 200.0, 12.0);
}

TEST(MetisPartition, SharesVerticesWithoutAnyEdge) {
  PartitionGraph graph;
  graph.offsets.assign(101, 0);
  graph.weights.assign(100, 1);
  for (const int parts : {2, 9}) {
    const auto part = metis_partition(graph, parts);
    ASSERT_EQ(part.size(), 100u);
    EXPECT_TRUE(all_within(part, parts));
  }
}

TEST(MetisPartition, RefusesListsThatDoNotFit) {
  EXPECT_THROW(metis_partition(grid_graph(3, 3), 0), SolveError);
  auto graph = grid_graph(3, 3);
  graph.weights.pop_back();
  EXPECT_THROW(metis_partition(graph, 2), SolveError);
  graph = grid_graph(3, 3);
  graph.neighbours.pop_back();
  EXPECT_THROW(metis_partition(graph, 2), SolveError);
  graph = grid_graph(3, 3);
  graph.neighbours[0] = 9;
  EXPECT_THROW(metis_partition(graph, 2), SolveError);
}

TEST(MetisPartition, ServesAsThePartitionerOfTheRun) {
  const auto graph = grid_graph(16, 16);
  const auto part = testing::world_partitioner()(graph, 4);
  ASSERT_EQ(part.size(), 256u);
  ASSERT_TRUE(all_within(part, 4));
  const auto weights = weight_of_parts(graph, part, 4);
  EXPECT_GT(*std::min_element(weights.begin(), weights.end()), 0);
}

}  // namespace
}  // namespace cdca
