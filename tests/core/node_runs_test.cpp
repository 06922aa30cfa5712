// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/node_runs.hpp"

#include "core/base/marked.hpp"
#include "core/mesh/local_mesh.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cdca {
namespace {

/// The checkerboard of blocks that one of three ranks owns: several runs in a row.
LocalMesh mesh_of_rank(int rank) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(11, 7), 11, 7);
  std::vector<int> owner;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 6; ++i) owner.push_back((i + j) % 3);
  return {grid, BlockPartition(grid, 2, owner), rank};
}

void expect_places(const LocalMesh& mesh, const std::vector<NodeRun>& runs) {
  for (const NodeRun& run : runs) {
    EXPECT_GT(run.count, 0);
    for (LocalId k = 0; k < run.count; ++k)
      EXPECT_EQ(mesh.node(run.first + k), (GridIndex{run.at.i + k, run.at.j}));
  }
}

TEST(NodeRuns, ListAllOwnNodes) {
  for (int rank = 0; rank < 3; ++rank) {
    const LocalMesh mesh = mesh_of_rank(rank);
    expect_places(mesh, mesh.own_runs());
    EXPECT_TRUE(nodes_between(mesh.own_runs(), mesh.owned_nodes()).empty());
  }
}

TEST(NodeRuns, WithoutSomeNodesTheOthersAreLeft) {
  const LocalMesh mesh = mesh_of_rank(1);
  std::mt19937 engine(3);
  for (unsigned of = 1; of < 9; ++of) {
    std::vector<char> flags(std::size_t(mesh.node_count()), 0);
    for (char& flag : flags) flag = engine() % of == 0;
    const std::vector<LocalId> all = marked(flags);
    const auto runs = runs_without(mesh.own_runs(), all);
    expect_places(mesh, runs);
    std::vector<LocalId> own;
    for (LocalId n = 0; n < mesh.owned_nodes(); ++n) {
      if (flags[std::size_t(n)]) own.push_back(n);
    }
    EXPECT_EQ(nodes_between(runs, mesh.owned_nodes()), own);
  }
}

TEST(Marked, AreThePlacesOfFlagsThatAreSet) {
  EXPECT_TRUE(marked(std::vector<char>()).empty());
  EXPECT_TRUE(marked(std::vector<char>(40, 0)).empty());
  EXPECT_EQ(marked(std::vector<char>{1, 0, 0, 1, 1}), (std::vector<LocalId>{0, 3, 4}));
}

}  // namespace
}  // namespace cdca
