// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/level_set.hpp"

#include "core/cells/cut_element.hpp"
#include "core/cracks/crack_paths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

namespace cdca {
namespace {

Crack crack_along(std::vector<Vec2> points) {
  Crack crack;
  crack.points = std::move(points);
  crack.born.assign(crack.segments(), {});
  return crack;
}

Vec2 gradient(const std::function<double(const Vec2&)>& f, const Vec2& x) {
  constexpr double h = 1e-5;
  return {(f(x + Vec2(h, 0)) - f(x - Vec2(h, 0))) / (2 * h),
          (f(x + Vec2(0, h)) - f(x - Vec2(0, h))) / (2 * h)};
}

TEST(LevelSetTest, DistanceIsPositiveOnTheLeft) {
  const Crack crack = crack_along({{1, 1}, {5, 4}});  // direction (0.8, 0.6)
  const LevelSet level_set(crack);
  const Vec2 middle(3, 2.5), left(-0.6, 0.8);
  EXPECT_NEAR(level_set.distance(middle + 0.7 * left), 0.7, 1e-14);
  EXPECT_NEAR(level_set.distance(middle - 0.7 * left), -0.7, 1e-14);
  EXPECT_NEAR(level_set.distance(middle), 0.0, 1e-14);
}

TEST(LevelSetTest, DistanceBeyondAnEndIsThatToTheEnd) {
  const Crack crack = crack_along({{1, 1}, {5, 1}});
  const LevelSet level_set(crack);
  EXPECT_NEAR(level_set.distance(Vec2(8, 5)), 5.0, 1e-14);
  EXPECT_NEAR(level_set.distance(Vec2(-2, -3)), -5.0, 1e-14);
}

TEST(LevelSetTest, DistanceOfAKinkedCrackIsTheSmallestWithTheSignOfTheSide) {
  // from rim to rim of the square [0, 10]^2: above it is the left side
  const std::vector<Vec2> points{{0, 3}, {3, 3}, {4, 7}, {6, 7}, {6.5, 2}, {10, 4}};
  const Crack crack = crack_along(points);
  const LevelSet level_set(crack);
  std::vector<Vec2> above = points;
  above.insert(above.end(), {{10, 10}, {0, 10}});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 10);
  for (int k = 0; k < 2000; ++k) {
    const Vec2 x(any(random), any(random));
    double nearest = 1e300;
    for (std::size_t s = 0; s < crack.segments(); ++s) {
      const Vec2 d = points[s + 1] - points[s];
      const double t = std::clamp((x - points[s]).dot(d) / d.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (x - points[s] - t * d).norm());
    }
    const double phi = level_set.distance(x);
    ASSERT_NEAR(std::abs(phi), nearest, 1e-12);
    ASSERT_EQ(phi > 0, contains(above, x)) << x.transpose();
  }
}

TEST(LevelSetTest, SecondLevelSetIsZeroAtTheTipAndGrowsOutOfTheCrack) {
  const Crack crack = crack_along({{1, 1}, {4, 1}, {4, 3}});
  const LevelSet level_set(crack);
  EXPECT_EQ(level_set.beyond_end(Vec2(4, 3), 1), 0.0);
  EXPECT_DOUBLE_EQ(level_set.beyond_end(Vec2(5, 3.5), 1), 0.5);
  EXPECT_DOUBLE_EQ(level_set.beyond_end(Vec2(3, 2), 1), -1.0);
  EXPECT_DOUBLE_EQ(level_set.beyond_end(Vec2(0.25, 7), 0), 0.75);
}

TEST(LevelSetTest, SecondLevelSetIsOrthogonalToTheFirstNearTheEnds) {
  const Crack crack = crack_along({{1, 1}, {4, 2}, {5, 4}});
  const LevelSet level_set(crack);
  const auto phi = [&](const Vec2& x) { return level_set.distance(x); };
  for (int end = 0; end < 2; ++end) {
    const auto beyond = [&](const Vec2& x) { return level_set.beyond_end(x, end); };
    const Vec2 tangent = crack.end_tangent(end);
    for (const double across : {-0.3, 0.2}) {
      const Vec2 x = crack.end_point(end) - 0.5 * tangent + across * turned_left(tangent);
      EXPECT_NEAR(gradient(phi, x).norm(), 1.0, 1e-8);
      EXPECT_NEAR(gradient(beyond, x).norm(), 1.0, 1e-8);
      EXPECT_NEAR(gradient(phi, x).dot(gradient(beyond, x)), 0.0, 1e-8);
    }
  }
}

/// How far the nearest end of the crack lies outside the element, in element sizes.
double gap_to_tip(const StructuredGrid& grid, const Crack& crack, GridIndex e) {
  double gap = 1e300;
  for (int end = 0; end < 2; ++end) {
    const Vec2 from_centre = grid.to_grid(crack.end_point(end)) - Vec2(e.i + 0.5, e.j + 0.5);
    gap = std::min(gap, (from_centre.cwiseAbs() - Vec2(0.5, 0.5)).cwiseMax(0.0).norm());
  }
  return gap;
}

class TypingTest : public ::testing::TestWithParam<Vec2> {};

/// Straight cracks in 21 x 21 places within an element, none of them through a node. Typed by the
/// level sets and by the path itself, elements may differ only where a tip lies almost on their
/// side: the distance to an end is not linear, and so Eq. 2 places the end a little too far ahead.
TEST_P(TypingTest, LevelSetsSeeTheElementsOnThePath) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(8, 16), 8, 8);
  int on_path = 0, besides = 0;
  for (int i = 0; i < 21; ++i)
    for (int j = 0; j < 21; ++j) {
      const Vec2 start = Vec2(1, 2) + Vec2((i + 0.37) / 21, (j + 0.59) / 21);
      const Crack crack = crack_along({grid.from_grid(start), grid.from_grid(start + GetParam())});
      const LevelSet level_set(crack);
      const CrackPaths paths(grid, {crack});
      for (const GridIndex e : narrow_band(grid, crack, 1)) {
        const CellKind kind = kind_of_element(grid, level_set, crack, e);
        const double gap = gap_to_tip(grid, crack, e);
        if (!paths.steps_in(e).empty()) {
          ++on_path;
          EXPECT_EQ(kind, gap == 0.0 ? CellKind::tip : CellKind::cut);
        } else if (kind != CellKind::continuous) {
          ++besides;
          EXPECT_EQ(kind, CellKind::tip);
          EXPECT_LT(gap, 0.5);
        }
      }
    }
  EXPECT_GT(on_path, 441 * 4);
  EXPECT_LT(besides, on_path / 10);
}

INSTANTIATE_TEST_SUITE_P(Directions, TypingTest,
                         ::testing::Values(Vec2(4.3, 1.9), Vec2(4.3, 0.3), Vec2(3.1, 3.5),
                                           Vec2(-0.4, 4.2), Vec2(5.0, 0.0)));

TEST(TypingOfEndsTest, ClosedEndsAreNoTips) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(8, 8), 8, 8);
  Crack crack = crack_along({{0, 3.4}, {4.5, 3.4}});
  crack.ends[0].state = TipState::boundary;
  const LevelSet level_set(crack);
  EXPECT_EQ(kind_of_element(grid, level_set, crack, {0, 3}), CellKind::cut);
  EXPECT_EQ(kind_of_element(grid, level_set, crack, {4, 3}), CellKind::tip);
  EXPECT_EQ(kind_of_element(grid, level_set, crack, {5, 3}), CellKind::continuous);
}

/// Elements within `margin` elements of those on the path.
std::set<GlobalId> surroundings(const StructuredGrid& grid, const CrackPaths& paths, int margin) {
  std::set<GlobalId> found;
  for (GlobalId id = 0; id < grid.element_count(); ++id) {
    const GridIndex e = grid.element_index(id);
    for (int dj = -margin; dj <= margin; ++dj)
      for (int di = -margin; di <= margin; ++di)
        if (!paths.steps_in({e.i + di, e.j + dj}).empty()) found.insert(id);
  }
  return found;
}

TEST(NarrowBandTest, HoldsTheElementsWithinTheMargin) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(12, 10), 12, 10);
  const Crack crack = crack_along({{2.3, 2.7}, {6.2, 4.1}, {6.4, 8.8}});
  const CrackPaths paths(grid, {crack});
  for (const int margin : {1, 2}) {
    std::set<GlobalId> band;
    for (const GridIndex e : narrow_band(grid, crack, margin)) band.insert(grid.element(e));
    // where the crack cuts off a corner, the band may be narrower by one
    const auto within = surroundings(grid, paths, margin - 1),
               widest = surroundings(grid, paths, margin);
    EXPECT_TRUE(std::includes(band.begin(), band.end(), within.begin(), within.end()));
    EXPECT_TRUE(std::includes(widest.begin(), widest.end(), band.begin(), band.end()));
  }
}

/// Sum of the weights of every node.
std::map<GlobalId, int> weights_of(const StructuredGrid& grid, const Crack& crack,
                                   double tip_radius) {
  std::map<GlobalId, int> sum;
  for (const CellWeight& w : cell_weights(grid, {crack}, tip_radius))
    sum[grid.node(w.node)] += w.extra;
  return sum;
}

TEST(CellWeightsTest, CornersOfCutElementsWeighTwoMoreAndOfTipElementsEight) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(8, 8), 8, 8);
  Crack crack = crack_along({{0, 3.4}, {4.5, 3.4}});
  crack.ends[0].state = TipState::boundary;
  const auto weights = weights_of(grid, crack, 0.0);
  EXPECT_EQ(weights.size(), 12u);
  for (int j = 3; j <= 4; ++j) {
    for (int i = 0; i <= 3; ++i) EXPECT_EQ(weights.at(grid.node({i, j})), 2);
    EXPECT_EQ(weights.at(grid.node({4, j})), 2 + 8);
    EXPECT_EQ(weights.at(grid.node({5, j})), 8);
  }
}

TEST(CellWeightsTest, TheRadiusOfATipCounts) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(8, 8), 16, 16);
  const Crack crack = crack_along({{2.1, 4.2}, {6.1, 4.2}});
  const auto weights = weights_of(grid, crack, 1.3);
  int within = 0;
  for (GlobalId id = 0; id < grid.node_count(); ++id) {
    const Vec2 x = grid.node_position(grid.node_index(id));
    for (int end = 0; end < 2; ++end) {
      if ((x - crack.end_point(end)).norm() > 1.3) continue;
      ++within;
      ASSERT_TRUE(weights.count(id));
      EXPECT_GE(weights.at(id), 8);
    }
  }
  EXPECT_EQ(
      std::count_if(weights.begin(), weights.end(), [](const auto& w) { return w.second >= 8; }),
      within);
}

}  // namespace
}  // namespace cdca
