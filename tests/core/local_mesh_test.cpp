// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/local_mesh.hpp"

#include "core/base/errors.hpp"
#include "core/base/halo.hpp"
#include "tests/world.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <ostream>
#include <set>
#include <string>

namespace cdca {
namespace {

using testing::world;

int blocks_along(int nodes, int block) { return (nodes + block - 1) / block; }

/// Blocks of cells owned as `owner(column, row)` of the block says.
BlockPartition partition_by(const StructuredGrid& grid, int block,
                            const std::function<int(int, int)>& owner) {
  std::vector<int> owners;
  for (int j = 0; j < blocks_along(grid.ny() + 1, block); ++j)
    for (int i = 0; i < blocks_along(grid.nx() + 1, block); ++i) owners.push_back(owner(i, j));
  return {grid, block, owners};
}

/// What one process can know of the meshes of several ranks.
struct Layout {
  std::string name;
  StructuredGrid grid;
  BlockPartition partition;
  int ranks;
};

std::ostream& operator<<(std::ostream& out, const Layout& layout) { return out << layout.name; }

Layout layout_of(std::string name, int nx, int ny, int block, int ranks,
                 const std::function<int(int, int)>& owner) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(nx, ny), nx, ny);
  return {std::move(name), grid, partition_by(grid, block, owner), ranks};
}

std::vector<Layout> layouts() {
  return {
      layout_of("one_rank", 7, 5, 1, 1, [](int, int) { return 0; }),
      layout_of("stripes", 7, 5, 1, 3, [](int i, int) { return i % 3; }),
      layout_of("checkerboard", 7, 5, 1, 4, [](int i, int j) { return 2 * (j % 2) + i % 2; }),
      layout_of("blocks_of_three", 10, 7, 3, 4, [](int i, int j) { return (i + 2 * j) % 4; }),
      layout_of("nothing_on_rank_one", 6, 6, 2, 3, [](int i, int) { return i < 2 ? 0 : 2; }),
      layout_of("one_block", 6, 4, 9, 3, [](int, int) { return 1; }),
      layout_of("islands", 8, 8, 1, 2, [](int i, int j) { return int(i % 4 == 1 && j % 4 == 2); }),
      layout_of("one_element", 1, 1, 1, 4, [](int i, int j) { return 2 * j + i; }),
  };
}

class LocalMeshTest : public ::testing::TestWithParam<Layout> {
 protected:
  void SetUp() override {
    for (int r = 0; r < GetParam().ranks; ++r)
      meshes_.emplace_back(GetParam().grid, GetParam().partition, r);
  }
  const StructuredGrid& grid() const { return GetParam().grid; }
  std::vector<LocalMesh> meshes_;
};

TEST_P(LocalMeshTest, EveryNodeIsOwnedExactlyOnce) {
  std::map<GlobalId, int> owners;
  for (const LocalMesh& mesh : meshes_)
    for (LocalId n = 0; n < mesh.owned_nodes(); ++n) ++owners[mesh.node_id(n)];
  ASSERT_EQ(GlobalId(owners.size()), grid().node_count());
  for (const auto& [id, count] : owners) EXPECT_EQ(count, 1) << "node " << id;
}

TEST_P(LocalMeshTest, OwnNodesComeFirstBothInOrderOfGlobalId) {
  for (const LocalMesh& mesh : meshes_)
    for (LocalId n = 0; n < mesh.node_count(); ++n) {
      EXPECT_EQ(mesh.owns(n), mesh.owner(mesh.node(n)) == mesh.rank());
      if (n > 0 && n != mesh.owned_nodes()) {
        EXPECT_LT(mesh.node_id(n - 1), mesh.node_id(n));
      }
    }
}

TEST_P(LocalMeshTest, HoldsTheElementsThatTouchItsNodesAndNoOthers) {
  for (const LocalMesh& mesh : meshes_) {
    LocalId expected = 0;
    for (GlobalId id = 0; id < grid().element_count(); ++id) {
      const GridIndex e = grid().element_index(id);
      bool touches = false;
      for (const GridIndex corner : grid().corners(e))
        touches = touches || mesh.owner(corner) == mesh.rank();
      EXPECT_EQ(mesh.find_element(e) >= 0, touches) << "element " << id;
      if (touches) {
        EXPECT_EQ(mesh.element(mesh.find_element(e)), e);
      }
      expected += touches;
    }
    EXPECT_EQ(mesh.element_count(), expected) << "none twice";
  }
}

TEST_P(LocalMeshTest, HoldsTheNodesOfItsElementsAndNoOthers) {
  for (const LocalMesh& mesh : meshes_) {
    std::set<GlobalId> needed;
    for (LocalId k = 0; k < mesh.element_count(); ++k) {
      const auto corners = grid().corners(mesh.element(k));
      const auto nodes = mesh.element_nodes(mesh.element(k));
      for (std::size_t a = 0; a < 4; ++a) {
        needed.insert(grid().node(corners[a]));
        EXPECT_EQ(mesh.node(nodes[a]), corners[a]);
      }
    }
    EXPECT_EQ(std::size_t(mesh.node_count()), needed.size());
    for (GlobalId id = 0; id < grid().node_count(); ++id)
      EXPECT_EQ(mesh.find_node(grid().node_index(id)) >= 0, needed.count(id) == 1);
  }
}

TEST_P(LocalMeshTest, EveryElementIsEvaluatedExactlyOnceByARankThatHoldsIt) {
  for (GlobalId id = 0; id < grid().element_count(); ++id) {
    const GridIndex e = grid().element_index(id);
    int count = 0;
    for (const LocalMesh& mesh : meshes_) {
      if (!mesh.evaluates(e)) continue;
      ++count;
      EXPECT_GE(mesh.find_element(e), 0);
    }
    EXPECT_EQ(count, 1) << "element " << id;
  }
}

TEST_P(LocalMeshTest, SharedListsMatchBetweenTheTwoRanks) {
  using Ids = std::vector<GlobalId>;
  std::map<std::pair<int, int>, Ids> sent, expected;  // from, to
  const auto ids = [](const LocalMesh& mesh, const std::vector<LocalId>& nodes) {
    Ids list;
    for (const LocalId n : nodes) list.push_back(mesh.node_id(n));
    return list;
  };
  for (const LocalMesh& mesh : meshes_) {
    std::set<LocalId> ghosts;
    for (const SharedNodes& shared : mesh.shared()) {
      EXPECT_NE(shared.rank, mesh.rank());
      EXPECT_FALSE(shared.owned.empty());
      for (const LocalId n : shared.owned) EXPECT_TRUE(mesh.owns(n));
      for (const LocalId n : shared.ghosts) {
        EXPECT_EQ(mesh.owner(mesh.node(n)), shared.rank);
        ghosts.insert(n);
      }
      sent[{mesh.rank(), shared.rank}] = ids(mesh, shared.owned);
      expected[{shared.rank, mesh.rank()}] = ids(mesh, shared.ghosts);
    }
    EXPECT_EQ(LocalId(ghosts.size()), mesh.node_count() - mesh.owned_nodes()) << "all are shared";
  }
  EXPECT_EQ(sent, expected);
}

INSTANTIATE_TEST_SUITE_P(Partitions, LocalMeshTest, ::testing::ValuesIn(layouts()),
                         [](const auto& test) { return test.param.name; });

TEST(LocalMeshOfNothing, HasNoCellsAndNoNeighbours) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(1, 1), 4, 4);
  const LocalMesh mesh(grid, BlockPartition(), 3);  // all cells on rank 0
  EXPECT_EQ(mesh.node_count(), 0);
  EXPECT_EQ(mesh.element_count(), 0);
  EXPECT_TRUE(mesh.shared().empty());
  EXPECT_EQ(mesh.find_node({2, 2}), -1);
}

TEST(BlockPartitionTest, RefusesAListThatDoesNotFitTheGrid) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(1, 1), 4, 4);
  EXPECT_THROW(BlockPartition(grid, 2, std::vector<int>(8, 0)), SolveError);  // 3 x 3 blocks
}

TEST(BlockPartitionTest, LargeGridsAreCutByBlocks) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(1, 1), 99, 49);  // 5000 cells
  SerialCommunicator alone;
  const Partitioner none;
  EXPECT_EQ(partition_cells(grid, {}, alone, none, 5000).block(), 1);
  const BlockPartition partition = partition_cells(grid, {}, alone, none, 200);
  EXPECT_EQ(partition.block(), 5);
  EXPECT_EQ(partition.blocks_x() * partition.blocks_y(), 200);
}

TEST(RowIndexTest, FindsEveryPlaceThatWasAddedAndNoOther) {
  RowIndex index;
  const std::vector<GridIndex> places{{3, 1}, {4, 1}, {6, 1}, {0, 2}, {1, 1}, {9, 4}, {8, 4}};
  for (std::size_t k = 0; k < places.size(); ++k) index.add(places[k], LocalId(k));
  index.finish();
  for (int j = -1; j < 7; ++j)
    for (int i = -1; i < 12; ++i) {
      LocalId expected = -1;
      for (std::size_t k = 0; k < places.size(); ++k)
        if (places[k] == GridIndex{i, j}) expected = LocalId(k);
      EXPECT_EQ(index.find({i, j}), expected) << i << ", " << j;
    }
}

/// Partitions of one grid over the ranks of the world, given a block's column and row.
struct HaloCase {
  const char* name;
  int block;
  int (*owner)(int i, int j, int ranks);
};

class HaloParallel : public ::testing::TestWithParam<HaloCase> {
 protected:
  void SetUp() override {
    const HaloCase& c = GetParam();
    mesh_ = LocalMesh(
        grid_,
        partition_by(grid_, c.block, [&](int i, int j) { return c.owner(i, j, world().size()); }),
        world().rank());
    std::vector<SharedUnknowns> shared;
    for (const SharedNodes& s : mesh_.shared()) shared.push_back({s.rank, s.owned, s.ghosts});
    halo_ = Halo(world(), std::move(shared));
  }
  const StructuredGrid grid_{Vec2(0, 0), Vec2(1, 1), 9, 7};
  LocalMesh mesh_;
  Halo halo_;
};

TEST_P(HaloParallel, CopiesTheOwnersValuesToTheGhosts) {
  std::vector<double> values(std::size_t(mesh_.node_count()), -1.0);
  for (LocalId n = 0; n < mesh_.owned_nodes(); ++n)
    values[std::size_t(n)] = double(mesh_.node_id(n));
  for (int repeat = 0; repeat < 2; ++repeat) halo_.copy_state(values);
  for (LocalId n = 0; n < mesh_.node_count(); ++n)
    EXPECT_EQ(values[std::size_t(n)], double(mesh_.node_id(n)));
}

TEST_P(HaloParallel, AddsTheForcesOnGhostsToTheOwnersAndClearsThem) {
  // every rank puts the global id on each node it holds: the owner gets it once per holder
  std::vector<double> values;
  std::vector<double> holders(std::size_t(grid_.node_count()), 0.0);
  for (LocalId n = 0; n < mesh_.node_count(); ++n) {
    values.push_back(1.0 + double(mesh_.node_id(n)));
    holders[std::size_t(mesh_.node_id(n))] = 1.0;
  }
  world().sum(std::span<double>(holders));
  halo_.add_forces(values);
  for (LocalId n = 0; n < mesh_.node_count(); ++n) {
    const double id = 1.0 + double(mesh_.node_id(n));
    EXPECT_EQ(values[std::size_t(n)],
              mesh_.owns(n) ? id * holders[std::size_t(mesh_.node_id(n))] : 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Partitions, HaloParallel,
    ::testing::Values(
        HaloCase{"stripes", 1, [](int i, int, int ranks) { return i % ranks; }},
        HaloCase{"blocks", 3, [](int i, int j, int ranks) { return (i + j) % ranks; }},
        HaloCase{"scattered", 1,
                 [](int i, int j, int ranks) { return (3 * i + 5 * j) / 2 % ranks; }},
        HaloCase{"nothing_on_the_last_rank", 2,
                 [](int i, int j, int ranks) { return ranks == 1 ? 0 : (i + j) % (ranks - 1); }}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace cdca
