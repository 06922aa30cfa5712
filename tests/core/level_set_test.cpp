// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/level_set.hpp"

#include "core/cells/cut_element.hpp"
#include "core/cracks/crack_paths.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace cdca {
namespace {

Crack crack_along(std::vector<Vec2> points) {
  Crack crack;
  crack.points = std::move(points);
  crack.age.assign(crack.segments(), 0);
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

/// Elements that the level sets and the paths of one crack see differently.
struct Comparison {
  int elements = 0, cut = 0, tip = 0, different = 0;
};

void compare(const StructuredGrid& grid, const Crack& crack, Comparison& sum) {
  const LevelSet level_set(crack);
  const CrackPaths paths(grid, {crack});
  for (GlobalId id = 0; id < grid.element_count(); ++id) {
    const GridIndex e = grid.element_index(id);
    const CellKind kind = kind_of_element(grid, level_set, crack, e);
    ++sum.elements;
    sum.cut += kind == CellKind::cut;
    sum.tip += kind == CellKind::tip;
    sum.different += (kind != CellKind::continuous) != !paths.steps_in(e).empty();
  }
}

TEST(LevelSetTest, TypesElementsAsThePathsDo) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(8, 8), 8, 8);
  Comparison sum;
  for (int i = 0; i < 21; ++i)
    for (int j = 0; j < 21; ++j) {
      const Vec2 shift((i + 0.37) / 21, (j + 0.59) / 21);  // no place on a grid line
      compare(grid, crack_along({Vec2(1, 2) + shift, Vec2(5.3, 3.9) + shift}), sum);
    }
  std::printf("%d %d %d different %d\n", sum.elements, sum.cut, sum.tip, sum.different);
  EXPECT_EQ(sum.different, 0);
}

}  // namespace
}  // namespace cdca
