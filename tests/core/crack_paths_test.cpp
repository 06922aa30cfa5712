// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/crack_paths.hpp"

#include "core/cracks/crack_registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace cdca {
namespace {

const StructuredGrid grid(Vec2(0, 0), Vec2(8, 6), 8, 6);  // grid coordinates are metres

CrackPaths paths_of(const std::vector<std::vector<Vec2>>& cracks, const StructuredGrid& on = grid) {
  CrackRegistry registry;
  for (const auto& points : cracks) registry.add("", points);
  registry.resolve_initial_meetings({on.origin(), on.origin() + on.size()},
                                    1e-3 * on.smallest_side());
  return {on, registry.cracks()};
}

std::vector<PathStep> steps_of(const CrackPaths& paths, int crack) {
  std::vector<PathStep> steps;
  for (const PathStep& s : paths.steps())
    if (s.crack == crack) steps.push_back(s);
  return steps;
}

bool has_vertex(const std::vector<PathStep>& steps, const Vec2& p) {
  return std::any_of(steps.begin(), steps.end(),
                     [&](const PathStep& s) { return s.from == p || s.to == p; });
}

/// How many elements list each step; every one of them must hold the whole step.
std::vector<int> listings(const CrackPaths& paths, const StructuredGrid& on = grid) {
  std::vector<int> count(paths.steps().size(), 0);
  for (GlobalId id = 0; id < on.element_count(); ++id) {
    const GridIndex e = on.element_index(id);
    for (const int k : paths.steps_in(e)) {
      ++count[std::size_t(k)];
      for (const Vec2& p : {paths.steps()[std::size_t(k)].from, paths.steps()[std::size_t(k)].to}) {
        EXPECT_GE(p.x(), e.i);
        EXPECT_LE(p.x(), e.i + 1);
        EXPECT_GE(p.y(), e.j);
        EXPECT_LE(p.y(), e.j + 1);
      }
    }
  }
  return count;
}

double length_of(const std::vector<PathStep>& steps) {
  double sum = 0.0;
  for (const PathStep& s : steps) sum += (s.to - s.from).norm();
  return sum;
}

void expect_one_line(const std::vector<PathStep>& steps) {
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) EXPECT_EQ(steps[k].to, steps[k + 1].from);
  for (const PathStep& s : steps) EXPECT_NE(s.from, s.to);
}

TEST(CrackPathsTest, NoCrackNoSteps) {
  const CrackPaths paths = paths_of({});
  EXPECT_TRUE(paths.steps().empty());
  EXPECT_TRUE(paths.tips().empty());
  EXPECT_TRUE(paths.steps_in({3, 3}).empty());
  EXPECT_TRUE(paths.steps_in({-1, 99}).empty());
}

TEST(CrackPathsTest, ChopsAStraightCrackAtTheGridLines) {
  const CrackPaths paths = paths_of({{{1.5, 1.25}, {4.5, 2.75}}});
  const auto steps = steps_of(paths, 0);
  ASSERT_EQ(steps.size(), 4u);  // at x = 2, 3, 4; y = 2 is met at x = 3
  expect_one_line(steps);
  EXPECT_NEAR(length_of(steps), std::hypot(3.0, 1.5), 1e-14);
  EXPECT_EQ(listings(paths), std::vector<int>(4, 1));
  EXPECT_TRUE(has_vertex(steps, Vec2(2, 1.5)));
  EXPECT_TRUE(has_vertex(steps, Vec2(3, 2))) << "a node that is met exactly";
}

TEST(CrackPathsTest, RandomCracksKeepTheirLengthAndStayInTheElements) {
  const StructuredGrid flat(Vec2(-3, 1), Vec2(2, 5), 11, 7);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-3, -1), y(1, 6);
  for (int k = 0; k < 300; ++k) {
    std::vector<Vec2> points;
    for (int n = 0; n < 2 + k % 4; ++n) points.emplace_back(x(random), y(random));
    Crack crack;
    crack.points = points;
    const CrackPaths paths(flat, {crack});
    expect_one_line(paths.steps());
    EXPECT_EQ(listings(paths, flat), std::vector<int>(paths.steps().size(), 1));
    double sum = 0.0;
    for (const PathStep& s : paths.steps())
      sum += (flat.from_grid(s.to) - flat.from_grid(s.from)).norm();
    EXPECT_NEAR(sum, crack.length(), 1e-6 * crack.length());
  }
}

TEST(CrackPathsTest, DiagonalCrackPassesThroughNodesOnly) {
  const CrackPaths paths = paths_of({{{0.5, 0.5}, {4.5, 4.5}}});
  ASSERT_EQ(paths.steps().size(), 5u);
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 8; ++i)
      EXPECT_EQ(paths.steps_in({i, j}).size(), i == j && i < 5 ? 1u : 0u) << i << ", " << j;
  for (int n = 1; n <= 4; ++n) EXPECT_TRUE(has_vertex(paths.steps(), Vec2(n, n)));
}

TEST(CrackPathsTest, PathsNearANodeRunThroughIt) {
  const double near = 0.3 * CrackPaths::snap;
  for (const Vec2& off : {Vec2(near, 0), Vec2(0, near), Vec2(-near, near), Vec2(0, -near)}) {
    const CrackPaths paths = paths_of({{Vec2(0.5, 0.5) + off, Vec2(4.5, 4.5) + off}});
    EXPECT_EQ(paths.steps().size(), 5u);
    for (int n = 1; n <= 4; ++n) EXPECT_TRUE(has_vertex(paths.steps(), Vec2(n, n)));
  }
}

TEST(CrackPathsTest, PathsMissANodeClearlyOrMeetIt) {
  for (int k = -60; k <= 60; ++k) {
    const Vec2 off(0, 0.05 * k * CrackPaths::snap);
    for (const double slope : {0.2, 1.0, -3.0, 1e-3}) {
      const CrackPaths paths =
          paths_of({{Vec2(2.5, 3 - 0.5 * slope) + off, Vec2(3.5, 3 + 0.5 * slope) + off}});
      expect_one_line(paths.steps());
      for (const PathStep& s : paths.steps())
        for (const Vec2& p : {s.from, s.to})
          EXPECT_TRUE(p == Vec2(3, 3) || (p - Vec2(3, 3)).norm() >= CrackPaths::snap);
      for (const int count : listings(paths)) EXPECT_GE(count, 1);
    }
  }
}

TEST(CrackPathsTest, StepsAlongAGridLineBelongToBothElements) {
  const CrackPaths paths = paths_of({{{1.5, 3}, {4.25, 3}}, {{6, 1.5}, {6, 3.5}}});
  EXPECT_EQ(listings(paths), std::vector<int>(paths.steps().size(), 2));
  EXPECT_EQ(steps_of(paths, 0).size(), 4u);
  for (const int i : {1, 2, 3, 4}) {
    EXPECT_EQ(paths.steps_in({i, 3}).size(), 1u);
    EXPECT_EQ(paths.steps_in({i, 3}), paths.steps_in({i, 2}));
  }
  for (const int j : {1, 2, 3}) EXPECT_EQ(paths.steps_in({5, j}), paths.steps_in({6, j}));
}

TEST(CrackPathsTest, CracksNearAGridLineRunAlongIt) {
  const double near = 0.4 * CrackPaths::snap;
  const CrackPaths paths = paths_of({{{1.5, 3 + near}, {4.25, 3 - near}}});
  for (const PathStep& s : paths.steps()) EXPECT_TRUE(s.from.y() == 3 && s.to.y() == 3);
}

TEST(CrackPathsTest, KinksInsideAnElementAreKept) {
  // enters and leaves the element (2, 2) by its left side
  const CrackPaths paths = paths_of({{{1.5, 2.25}, {2.5, 2.5}, {1.5, 2.75}}});
  EXPECT_EQ(paths.steps_in({2, 2}).size(), 2u);
  EXPECT_TRUE(has_vertex(paths.steps(), Vec2(2.5, 2.5)));
  EXPECT_NEAR(length_of(paths.steps()), 2 * std::hypot(1.0, 0.25), 1e-14);
  EXPECT_EQ(paths.steps().front().segment, 0);
  EXPECT_EQ(paths.steps().back().segment, 1);
}

TEST(CrackPathsTest, CrackInsideOneElementIsOneStep) {
  const CrackPaths paths = paths_of({{{2.25, 2.25}, {2.75, 2.5}}});
  ASSERT_EQ(paths.steps().size(), 1u);
  EXPECT_EQ(paths.steps_in({2, 2}), std::vector<int>{0});
}

TEST(CrackPathsTest, CrossingCracksShareAPoint) {
  const CrackPaths paths = paths_of({{{1.1, 1.3}, {5.2, 4.9}}, {{1.2, 4.1}, {5.7, 1.9}}});
  std::vector<Vec2> common;
  for (const PathStep& s : steps_of(paths, 0))
    if (has_vertex(steps_of(paths, 1), s.to)) common.push_back(s.to);
  ASSERT_EQ(common.size(), 1u) << "bitwise";
  for (int crack = 0; crack < 2; ++crack) expect_one_line(steps_of(paths, crack));
  const Vec2 a(1.1, 1.3), d(4.1, 3.6);
  EXPECT_LT(std::abs(cross(common[0] - a, d)) / d.norm(), 1e-12);
}

TEST(CrackPathsTest, TouchingEndSplitsItsPartner) {
  const Vec2 foot = Vec2(1.1, 1.3) + 0.37 * Vec2(4.1, 3.6);
  const CrackPaths paths = paths_of({{{1.1, 1.3}, {5.2, 4.9}}, {{3.1, 5.2}, foot}});
  EXPECT_TRUE(has_vertex(steps_of(paths, 0), steps_of(paths, 1).back().to));
  expect_one_line(steps_of(paths, 0));
}

TEST(CrackPathsTest, ConnectedEndsArePlacedTogether) {
  const CrackPaths paths =
      paths_of({{{1.1, 1.3}, {3.3, 2.7}}, {{6.1, 4.2}, {3.3, 2.7}}, {{3.3, 2.7}, {3.4, 5.2}}});
  EXPECT_EQ(steps_of(paths, 0).back().to, steps_of(paths, 1).back().to);
  EXPECT_EQ(steps_of(paths, 0).back().to, steps_of(paths, 2).front().from);
}

TEST(CrackPathsTest, ListsActiveTipsOnly) {
  const CrackPaths paths = paths_of({{{0, 2.3}, {3.2, 2.3}}, {{5.5, 5.5}, {2.5, 2.3}}});
  ASSERT_EQ(paths.tips().size(), 2u);
  EXPECT_EQ(paths.tips()[0].crack, 0);
  EXPECT_EQ(paths.tips()[0].end, 1);
  EXPECT_TRUE(paths.tips()[0].at.isApprox(Vec2(3.2, 2.3), 1e-15));
  EXPECT_EQ(paths.tips()[1].crack, 1);
  EXPECT_EQ(paths.tips()[1].end, 0);
}

TEST(CrackPathsTest, CrackOnTheRimBelongsToOneElement) {
  const CrackPaths paths = paths_of({{{2.5, 6}, {3.5, 6}}});
  EXPECT_EQ(listings(paths), std::vector<int>(paths.steps().size(), 1));
}

}  // namespace
}  // namespace cdca
