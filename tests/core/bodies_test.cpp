// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/bodies.hpp"

#include "core/base/errors.hpp"
#include "core/simulation/model.hpp"
#include "tests/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace cdca {
namespace {

using testing::world;
using Polylines = std::vector<std::vector<Vec2>>;

/// The pieces of a square of 8 x 8 elements of size one on all ranks, cells shared out diagonally.
class Pieces {
 public:
  explicit Pieces(const Polylines& cracks) {
    for (const auto& points : cracks) registry_.add("", points);
    registry_.resolve_initial_meetings({Vec2(0, 0), Vec2(8, 8)}, 1e-3);
    cuts_ = ElementCuts(grid_, CrackPaths(grid_, registry_.cracks()));
    std::vector<int> owner;
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 5; ++i) owner.push_back((i + j) % world().size());
    mesh_ = LocalMesh(grid_, BlockPartition(grid_, 2, owner), world().rank());
    unknowns_ = CellUnknowns(mesh_, cuts_, zones_, world());
  }
  BasisContext context() const { return {mesh_, cuts_, zones_, unknowns_}; }
  Bodies with_marks(const std::vector<BoundarySpec>& supports,
                    const std::vector<PieceMarks>& marks) const {
    return {context(), Supports(context(), supports).flags(unknowns_.count()), marks, world()};
  }
  std::vector<Body> bodies(const std::vector<BoundarySpec>& supports = {}) const {
    return with_marks(supports, {}).list();
  }
  std::int64_t count() const {
    std::int64_t own = 0;
    for (LocalId n = 0; n < mesh_.owned_nodes(); ++n) own += unknowns_.pieces(n);
    return world().sum(own);
  }

 private:
  const StructuredGrid grid_{Vec2(0, 0), Vec2(8, 8), 8, 8};
  CrackRegistry registry_;
  ElementCuts cuts_;
  std::vector<TipZone> zones_;
  LocalMesh mesh_;
  CellUnknowns unknowns_;
};

BoundarySpec side(Side which, bool x, bool y) {
  BoundarySpec b;
  b.kind = BoundaryKind::side;
  b.side = which;
  if (x) b.displacement[0] = proportional_load(0);
  if (y) b.displacement[1] = proportional_load(0);
  return b;
}

BoundarySpec point(const Vec2& at, bool x, bool y) {
  BoundarySpec b = side(Side::left, x, y);
  b.kind = BoundaryKind::point;
  b.at = at;
  return b;
}

/// Counted bodies hold all pieces.
void expect_bodies(const Polylines& cracks, std::size_t count) {
  const Pieces pieces(cracks);
  const auto bodies = pieces.bodies();
  EXPECT_EQ(bodies.size(), count);
  std::int64_t sum = 0;
  for (const Body& body : bodies) {
    EXPECT_GT(body.pieces, 0);
    EXPECT_FALSE(body.held) << "nothing holds it";
    sum += body.pieces;
  }
  EXPECT_EQ(sum, pieces.count());
}

const std::vector<Vec2> across{{0, 3.4}, {8, 4.7}};

TEST(BodiesParallel, UncutPlateIsOne) { expect_bodies({}, 1); }
TEST(BodiesParallel, CrackThatEndsInsideLeavesOne) { expect_bodies({{{0, 3.4}, {6.3, 4.7}}}, 1); }
TEST(BodiesParallel, CrackFromSideToSideMakesTwo) { expect_bodies({across}, 2); }
TEST(BodiesParallel, TouchingCrackMakesThree) { expect_bodies({across, {{4.2, 8}, {4, 4.05}}}, 3); }
TEST(BodiesParallel, CrossingMakesFour) { expect_bodies({across, {{4.2, 8}, {3.9, 0}}}, 4); }
TEST(BodiesParallel, CrackAlongAGridLineMakesTwo) { expect_bodies({{{0, 4}, {8, 4}}}, 2); }
TEST(BodiesParallel, CrackThroughNodesMakesTwo) { expect_bodies({{{0, 0}, {8, 8}}}, 2); }
TEST(BodiesParallel, RingOfCracksMakesAnIsland) {
  expect_bodies({{{2.3, 2.4}, {5.6, 2.7}}, {{5.6, 2.7}, {4.1, 5.6}}, {{4.1, 5.6}, {2.3, 2.4}}}, 2);
}
TEST(BodiesParallel, IslandWithinOneElementsReachCounts) {
  expect_bodies({{{3.3, 3.3}, {4.7, 3.4}}, {{4.7, 3.4}, {4.1, 4.7}}, {{4.1, 4.7}, {3.3, 3.3}}}, 2);
}
TEST(BodiesParallel, OpenRingLeavesOne) {
  expect_bodies({{{2.3, 2.4}, {5.6, 2.7}}, {{5.6, 2.7}, {4.1, 5.6}}}, 1);
}

TEST(BodiesParallel, AreTheSameListOnAllRanks) {
  const auto bodies = Pieces({across, {{4.2, 8}, {4, 4.05}}}).bodies();
  std::vector<double> numbers;
  for (const Body& body : bodies)
    numbers.insert(numbers.end(), {body.at.x(), body.at.y(), double(body.pieces)});
  std::vector<double> largest = numbers, smallest = numbers;
  world().max(std::span<double>(largest));
  world().min(std::span<double>(smallest));
  EXPECT_EQ(largest, smallest);
}

TEST(BodiesParallel, CollectTheMarksOfTheirPieces) {
  const Pieces pieces({across, {{4.2, 8}, {4, 4.05}}});
  // one bit for the lower rim, one each for the upper corners
  const BasisContext context = pieces.context();
  const LocalMesh& mesh = context.mesh;
  const auto marks = [&mesh](LocalId n) -> std::uint64_t {
    const GridIndex at = mesh.node(n);
    return at.j == 0 ? 1 : at.j < 8 ? 0 : at.i == 0 ? 2 : at.i == 8 ? 4 : 0;
  };
  std::vector<PieceMarks> listed;
  for (LocalId n = 0; n < mesh.node_count(); ++n) {
    for (int p = 0; p < context.unknowns.pieces(n); ++p) listed.push_back({n, p, marks(n)});
  }
  const Bodies bodies = pieces.with_marks({}, listed);
  ASSERT_EQ(bodies.list().size(), 3u);
  std::vector<std::uint64_t> found;
  for (const Body& body : bodies.list()) found.push_back(body.marks);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<std::uint64_t>{1, 2, 4}));
  for (LocalId n = 0; n < mesh.node_count(); ++n) {
    if (marks(n) == 0) continue;
    EXPECT_EQ(bodies.list().at(bodies.body_of(n, 0)).marks, marks(n)) << "node " << mesh.node_id(n);
  }
}

TEST(BodiesParallel, NameAPlaceInEachOfThem) {
  const auto bodies = Pieces({across}).bodies();
  ASSERT_EQ(bodies.size(), 2u);
  const auto height_over_crack = [](const Vec2& x) { return x.y() - (3.4 + 1.3 * x.x() / 8); };
  EXPECT_LT(height_over_crack(bodies[0].at) * height_over_crack(bodies[1].at), 0.0);
}

TEST(BodiesParallel, AreHeldOneByOne) {
  const auto bodies = Pieces({across}).bodies({side(Side::bottom, true, true)});
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_NE(bodies[0].held, bodies[1].held);
}

bool held(const std::vector<BoundarySpec>& supports, const Polylines& cracks = {}) {
  const auto bodies = Pieces(cracks).bodies(supports);
  return std::all_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.held; });
}

TEST(BodiesParallel, OneFixedPointLeavesTheRotation) {
  EXPECT_FALSE(held({point({0, 0}, true, true)}));
  EXPECT_FALSE(held({point({3, 5}, true, true)}));
}

TEST(BodiesParallel, RollersOnOneSideLeaveATranslation) {
  EXPECT_FALSE(held({side(Side::bottom, false, true)}));
  EXPECT_TRUE(held({side(Side::bottom, false, true), point({8, 8}, true, false)}));
}

TEST(BodiesParallel, SupportsWhoseLinesMeetInOnePointLeaveTheRotation) {
  const BoundarySpec fixed = point({0, 0}, true, true);
  EXPECT_FALSE(held({fixed, point({8, 0}, true, false)})) << "pulls through the fixed point";
  EXPECT_TRUE(held({fixed, point({8, 0}, false, true)}));
  EXPECT_TRUE(held({fixed, point({0, 8}, true, false)}));
}

TEST(BodiesParallel, TwoPartsNeedSupportsOfTheirOwn) {
  EXPECT_FALSE(held({side(Side::bottom, true, true)}, {across}));
  EXPECT_TRUE(held({side(Side::bottom, true, true), side(Side::top, true, true)}, {across}));
  EXPECT_TRUE(held({side(Side::left, true, true)}, {across}));
}

CaseSpec plate(const Polylines& cracks, std::vector<BoundarySpec> boundaries) {
  CaseSpec spec;
  spec.domain.size = {8, 8};
  spec.domain.cells = {8, 8};
  spec.material.young = 1.0;
  spec.material.poisson = 0.3;
  for (const auto& points : cracks) spec.cracks.push_back({"c", points, 1});
  spec.boundaries = std::move(boundaries);
  return spec;
}

/// The messages with which the model refuses a case.
std::vector<std::string> refused(const CaseSpec& spec) {
  std::vector<std::string> messages;
  try {
    const Model model(spec, world(), testing::world_partitioner());
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) messages.push_back(problem.message);
  }
  return messages;
}

TEST(BodiesParallel, ModelRefusesALoosePart) {
  const auto messages = refused(plate({across}, {side(Side::bottom, true, true)}));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("no support holds"), std::string::npos);
}

TEST(BodiesParallel, ModelRefusesAnIsland) {
  const Polylines ring{
      {{2.3, 2.4}, {5.6, 2.7}}, {{5.6, 2.7}, {4.1, 5.6}}, {{4.1, 5.6}, {2.3, 2.4}}};
  EXPECT_EQ(refused(plate(ring, {side(Side::bottom, true, true)})).size(), 1u);
}

TEST(BodiesParallel, ModelRefusesABodyThatCanTurn) {
  const auto messages = refused(plate({}, {point({0, 0}, true, true)}));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("free to move"), std::string::npos);
}

TEST(BodiesParallel, ModelTakesPartsThatAreHeld) {
  EXPECT_TRUE(refused(plate({across}, {side(Side::left, true, true)})).empty());
}

TEST(BodiesParallel, ModelRefusesCracksWithBothTipsInOneElement) {
  const auto messages = refused(plate({{{2.2, 2.3}, {2.7, 2.8}}}, {side(Side::left, true, true)}));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("one element"), std::string::npos);
}

}  // namespace
}  // namespace cdca
