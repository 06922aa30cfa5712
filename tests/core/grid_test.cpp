// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/grid.hpp"

#include "core/mesh/shape_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace cdca {
namespace {

const StructuredGrid grid(Vec2(-1.0, 2.0), Vec2(3.0, 0.5), 6, 5);  // elements of 0.5 x 0.1

TEST(GridTest, NumbersNodesAndElementsRowByRow) {
  EXPECT_EQ(grid.node_count(), 42);
  EXPECT_EQ(grid.element_count(), 30);
  EXPECT_EQ(grid.node({0, 0}), 0);
  EXPECT_EQ(grid.node({6, 0}), 6);
  EXPECT_EQ(grid.node({0, 1}), 7);
  EXPECT_EQ(grid.element({0, 1}), 6);
  GlobalId next = 0;
  for (int j = 0; j <= 5; ++j)
    for (int i = 0; i <= 6; ++i, ++next) EXPECT_EQ(grid.node_index(next), (GridIndex{i, j}));
  next = 0;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 6; ++i, ++next) {
      EXPECT_EQ(grid.element({i, j}), next);
      EXPECT_EQ(grid.element_index(next), (GridIndex{i, j}));
    }
}

TEST(GridTest, NumbersBeyondThirtyTwoBits) {
  const StructuredGrid large(Vec2(0, 0), Vec2(1, 1), 100000, 100000);
  EXPECT_EQ(large.node_count(), 10000200001);
  EXPECT_EQ(large.element_count(), 10000000000);
  EXPECT_EQ(large.node_index(large.node({99999, 100000})), (GridIndex{99999, 100000}));
}

TEST(GridTest, PlacesNodes) {
  EXPECT_TRUE(grid.element_size().isApprox(Vec2(0.5, 0.1), 1e-15));
  EXPECT_DOUBLE_EQ(grid.smallest_side(), 0.1);
  EXPECT_TRUE(grid.node_position({3, 2}).isApprox(Vec2(0.5, 2.2), 1e-15));
}

TEST(GridTest, LastNodesLieOnTheRimToTheLastBit) {
  const StructuredGrid odd(Vec2(0.1, 0), Vec2(0.7, 0.3), 7, 3);  // 7 * 0.1 is not 0.7 in binary
  EXPECT_EQ(odd.node_position({7, 3}), odd.origin() + odd.size());
}

TEST(GridTest, GridCoordinatesInvert) {
  const Vec2 x(0.333, 2.411);
  EXPECT_TRUE(grid.from_grid(grid.to_grid(x)).isApprox(x, 1e-15));
  EXPECT_TRUE(grid.to_grid(x).isApprox(Vec2(2.666, 4.11), 1e-14));
  EXPECT_TRUE(grid.to_grid(grid.node_position({4, 3})).isApprox(Vec2(4, 3), 1e-14));
}

TEST(GridTest, CornersGoRoundCounterClockwise) {
  const auto corners = grid.corners({2, 3});
  double twice_area = 0.0;
  for (std::size_t a = 0; a < 4; ++a)
    twice_area += cross(grid.node_position(corners[a]), grid.node_position(corners[(a + 1) % 4]));
  EXPECT_NEAR(0.5 * twice_area, 0.05, 1e-14);
  EXPECT_EQ(corners[0], (GridIndex{2, 3}));
}

TEST(GridTest, NodeIsTheCornerOppositeToTheSlotOfEachElementRoundIt) {
  const GridIndex node{3, 2};
  const auto elements = grid.elements_round(node);
  std::set<GlobalId> different;
  for (std::size_t slot = 0; slot < 4; ++slot) {
    EXPECT_EQ(grid.corners(elements[slot])[(slot + 2) % 4], node);
    different.insert(grid.element(elements[slot]));
  }
  EXPECT_EQ(different.size(), 4u);
}

TEST(GridTest, KnowsWhichElementsExist) {
  EXPECT_TRUE(grid.has_element({0, 0}));
  EXPECT_TRUE(grid.has_element({5, 4}));
  for (const GridIndex outside : {GridIndex{-1, 0}, {0, -1}, {6, 0}, {0, 5}})
    EXPECT_FALSE(grid.has_element(outside));
}

TEST(GridTest, FindsTheElementOfAPlace) {
  EXPECT_EQ(grid.element_at(Vec2(2.5, 3.999)), (GridIndex{2, 3}));
  EXPECT_EQ(grid.element_at(Vec2(2.0, 3.0)), (GridIndex{2, 3})) << "lower sides belong to it";
}

TEST(GridTest, PlacesOnTheRimBelongInside) {
  EXPECT_EQ(grid.element_at(Vec2(0, 0)), (GridIndex{0, 0}));
  EXPECT_EQ(grid.element_at(Vec2(6, 5)), (GridIndex{5, 4}));
  EXPECT_EQ(grid.element_at(Vec2(6 + 1e-12, 2.5)), (GridIndex{5, 2}));
  EXPECT_EQ(grid.element_at(Vec2(-1e-12, 2.5)), (GridIndex{0, 2}));
}

TEST(GridTest, FindsTheNearestNode) {
  EXPECT_EQ(grid.nearest_node(Vec2(0.74, 2.24)), (GridIndex{3, 2}));
  EXPECT_EQ(grid.nearest_node(Vec2(0.76, 2.26)), (GridIndex{4, 3}));
  EXPECT_EQ(grid.nearest_node(Vec2(50, -50)), (GridIndex{6, 0}));
}

TEST(ShapeFunctionsTest, AreOneAtTheirOwnCornerOnly) {
  const Vec2 corner[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < 4; ++b)
      EXPECT_EQ(shape_functions(corner[b], Vec2(1, 1)).value[a], a == b ? 1.0 : 0.0);
}

TEST(ShapeFunctionsTest, AddUpToOneAndReproducePlaces) {
  const Vec2 h(0.5, 0.1), corner[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const Vec2& p : {Vec2(0.3, 0.8), Vec2(0.0, 0.45), Vec2(0.99, 0.02)}) {
    const ShapeValues n = shape_functions(p, h);
    double sum = 0.0;
    Vec2 place(0, 0), slope(0, 0);
    Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();  // of the place itself: the unit matrix
    for (std::size_t a = 0; a < 4; ++a) {
      sum += n.value[a];
      place += n.value[a] * corner[a];
      slope += n.gradient[a];
      gradient += corner[a].cwiseProduct(h) * n.gradient[a].transpose();
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    EXPECT_LT((place - p).norm(), 1e-15);
    EXPECT_LT(slope.norm(), 1e-14);
    EXPECT_LT((gradient - Eigen::Matrix2d::Identity()).norm(), 1e-14);
  }
}

TEST(ShapeFunctionsTest, GradientsAreDifferences) {
  const Vec2 h(0.5, 0.1), p(0.3, 0.8);
  const double step = 1e-3;  // bilinear: differences along x and y are exact
  const ShapeValues n = shape_functions(p, h);
  for (int axis = 0; axis < 2; ++axis) {
    Vec2 d(0, 0);
    d[axis] = step / h[axis];
    const ShapeValues low = shape_functions(p - d, h), high = shape_functions(p + d, h);
    for (std::size_t a = 0; a < 4; ++a)
      EXPECT_NEAR((high.value[a] - low.value[a]) / (2 * step), n.gradient[a][axis], 1e-11);
  }
}

}  // namespace
}  // namespace cdca
