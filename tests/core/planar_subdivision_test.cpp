// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/planar_subdivision.hpp"

#include "core/cracks/segments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <random>
#include <set>
#include <string>

namespace cdca {
namespace {

using Segments = std::vector<TaggedSegment>;

/// Straight lines through the points, all with one tag.
Segments line(std::initializer_list<Vec2> points, int tag = 0) {
  Segments segments;
  const std::vector<Vec2> p(points);
  for (std::size_t k = 0; k + 1 < p.size(); ++k) segments.push_back({p[k], p[k + 1], tag});
  return segments;
}

Segments operator+(Segments a, const Segments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double total_area(const PlanarSubdivision& plane) {
  double sum = 0.0;
  for (std::size_t k = 0; k < plane.polygons().size(); ++k) sum += plane.area(k);
  return sum;
}

bool is_simple(const std::vector<Vec2>& loop) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l) {
      if ((loop[k] - loop[l]).norm() < 1e-9) return false;
      if (crossing_of(loop[k], loop[(k + 1) % loop.size()], loop[l], loop[l + 1])) return false;
    }
  }
  return true;
}

/// What holds in every arrangement.
void expect_sound(const PlanarSubdivision& plane) {
  EXPECT_NEAR(total_area(plane), 1.0, 1e-12);
  for (std::size_t k = 0; k < plane.polygons().size(); ++k) {
    EXPECT_GT(plane.area(k), 0.0);
    EXPECT_TRUE(is_simple(plane.loop(k)));
  }
  for (const SubdivisionEdge& e : plane.edges()) {
    EXPECT_EQ(std::min(e.left, e.right) < 0, e.tag == PlanarSubdivision::rim);
    EXPECT_GE(std::max(e.left, e.right), 0);
    EXPECT_NE(e.left, e.right) << "no slits";
  }
}

struct Arrangement {
  std::string name;
  Segments segments;
  std::size_t polygons;
};

std::ostream& operator<<(std::ostream& out, const Arrangement& a) { return out << a.name; }

class PlanarSubdivisionTest : public ::testing::TestWithParam<Arrangement> {};

TEST_P(PlanarSubdivisionTest, SplitsTheSquare) {
  const PlanarSubdivision plane(GetParam().segments);
  EXPECT_EQ(plane.polygons().size(), GetParam().polygons);
  expect_sound(plane);
}

TEST_P(PlanarSubdivisionTest, SplitsItsMirrorImageAlike) {
  Segments mirrored = GetParam().segments;
  for (TaggedSegment& s : mirrored) {
    s.from = Vec2(1 - s.from.y(), s.from.x());  // turned by 90 degrees, and the other way round
    s.to = Vec2(1 - s.to.y(), s.to.x());
    std::swap(s.from, s.to);
  }
  const PlanarSubdivision plane(GetParam().segments), turned(mirrored);
  expect_sound(turned);
  ASSERT_EQ(turned.polygons().size(), plane.polygons().size());
  std::vector<double> areas, areas_turned;
  for (std::size_t k = 0; k < plane.polygons().size(); ++k) {
    areas.push_back(plane.area(k));
    areas_turned.push_back(turned.area(k));
  }
  std::sort(areas.begin(), areas.end());
  std::sort(areas_turned.begin(), areas_turned.end());
  for (std::size_t k = 0; k < areas.size(); ++k) EXPECT_NEAR(areas[k], areas_turned[k], 1e-12);
}

const std::vector<Arrangement> arrangements{
    {"nothing", {}, 1},
    {"straight_cut", line({{0, 0.3}, {1, 0.6}}), 2},
    {"corner_to_corner", line({{0, 0}, {1, 1}}), 2},
    {"corner_to_side", line({{0, 1}, {0.4, 0}}), 2},
    {"kink_inside", line({{0, 0.3}, {0.4, 0.8}, {1, 0.6}}), 2},
    {"in_and_out_by_one_side", line({{0, 0.2}, {0.5, 0.5}, {0, 0.8}}), 2},
    {"tip_inside", line({{0, 0.3}, {0.4, 0.4}}), 2},
    {"tip_behind_a_kink", line({{0, 0.3}, {0.4, 0.4}, {0.5, 0.7}}), 2},
    {"tip_that_looks_at_a_corner", line({{0, 0}, {0.4, 0.4}}), 2},
    {"two_tips_side_by_side", line({{0, 0.3}, {0.4, 0.3}}) + line({{1, 0.7}, {0.6, 0.7}}, 1), 3},
    {"two_tips_that_meet_head_on", line({{0, 0.5}, {0.4, 0.5}}) + line({{1, 0.5}, {0.6, 0.5}}, 1),
     2},
    {"crack_inside", line({{0.3, 0.4}, {0.6, 0.5}}), 2},
    {"tip_that_looks_at_a_crack", line({{0, 0.5}, {0.4, 0.5}}) + line({{0.7, 0}, {0.6, 1}}, 1), 3},
    {"crossing", line({{0, 0.3}, {1, 0.7}}) + line({{0.4, 0}, {0.5, 1}}, 1), 4},
    {"crossing_at_the_middle", line({{0, 0}, {1, 1}}) + line({{0, 1}, {1, 0}}, 1), 4},
    {"touching", line({{0, 0.3}, {0.5, 0.5}, {1, 0.7}}) + line({{0.4, 1}, {0.5, 0.5}}, 1), 3},
    {"meeting_inside",
     line({{0, 0.3}, {0.5, 0.5}}) + line({{1, 0.4}, {0.5, 0.5}}, 1) +
         line({{0.6, 1}, {0.5, 0.5}}, 2),
     3},
    {"three_that_cross",
     line({{0, 0.3}, {1, 0.4}}) + line({{0.2, 0}, {0.7, 1}}, 1) + line({{0.8, 0}, {0.3, 1}}, 2), 7},
    {"three_through_one_place",
     line({{0, 0.5}, {0.5, 0.5}, {1, 0.5}}) + line({{0.5, 0}, {0.5, 0.5}, {0.5, 1}}, 1) +
         line({{0, 0}, {0.5, 0.5}, {1, 1}}, 2),
     6},
    {"along_a_side", line({{0, 0}, {0.6, 0}}), 1},
    {"along_all_of_a_side", line({{1, 0}, {1, 1}}), 1},
    {"along_a_side_then_inside", line({{0, 0}, {0.5, 0}, {0.8, 0.6}}), 2},
    {"twice_the_same", line({{0, 0.3}, {1, 0.6}}) + line({{0, 0.3}, {1, 0.6}}, 1), 2},
    {"overlapping", line({{0, 0.5}, {0.6, 0.5}}) + line({{1, 0.5}, {0.4, 0.5}}, 1), 2},
};

INSTANTIATE_TEST_SUITE_P(Arrangements, PlanarSubdivisionTest, ::testing::ValuesIn(arrangements),
                         [](const auto& test) { return test.param.name; });

TEST(PlanarSubdivisionOfRandomLines, IsSound) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0, 1);
  const auto on_rim = [&] {
    const double t = any(random);
    const int side = int(4 * any(random));
    return side == 0 ? Vec2(t, 0) : side == 1 ? Vec2(1, t) : side == 2 ? Vec2(t, 1) : Vec2(0, t);
  };
  const auto inside = [&] { return Vec2(any(random), any(random)); };
  for (int k = 0; k < 2000; ++k) {
    Segments segments;
    const int count = 1 + int(5 * any(random));
    for (int tag = 0; tag < count; ++tag) {
      const Vec2 from = any(random) < 0.5 ? on_rim() : inside();
      segments.push_back({from, any(random) < 0.5 ? on_rim() : inside(), tag});
    }
    const PlanarSubdivision plane(segments);
    expect_sound(plane);
    std::set<int> used;
    for (const SubdivisionEdge& e : plane.edges()) used.insert({e.a, e.b});
    EXPECT_EQ(int(used.size() + plane.polygons().size()) - int(plane.edges().size()), 1) << "Euler";
    if (HasFailure()) FAIL() << "case " << k;
  }
}

TEST(PlanarSubdivisionAreas, AreThoseOfThePolygons) {
  const PlanarSubdivision plane(line({{0, 0.3}, {0.4, 0.8}, {1, 0.6}}));
  ASSERT_EQ(plane.polygons().size(), 2u);
  // trapezoids under the crack
  const double below = 0.4 * (0.3 + 0.8) / 2 + 0.6 * (0.8 + 0.6) / 2;
  EXPECT_NEAR(std::min(plane.area(0), plane.area(1)), 1 - below, 1e-14);
  EXPECT_NEAR(std::max(plane.area(0), plane.area(1)), below, 1e-14);
}

TEST(PlanarSubdivisionEdges, LieBetweenTheFacesOnTheirSides) {
  const PlanarSubdivision plane(line({{0, 0.3}, {1, 0.6}}, 7));
  for (const SubdivisionEdge& e : plane.edges()) {
    if (e.tag != 7) continue;
    // from left to right, so the upper face is on the left
    EXPECT_NEAR(plane.area(std::size_t(e.left)), 0.55, 1e-14);
    EXPECT_NEAR(plane.area(std::size_t(e.right)), 0.45, 1e-14);
  }
}

TEST(PlanarSubdivisionTips, AreCornersOfTheFacesRoundThem) {
  const PlanarSubdivision plane(line({{0, 0.3}, {0.4, 0.4}}));
  int virtual_edges = 0;
  for (const SubdivisionEdge& e : plane.edges())
    virtual_edges += e.tag == PlanarSubdivision::prolonged;
  EXPECT_EQ(virtual_edges, 1);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto loop = plane.loop(k);
    EXPECT_NE(std::find(loop.begin(), loop.end(), Vec2(0.4, 0.4)), loop.end());
  }
}

TEST(PlanarSubdivisionOfARing, HasAFaceInsideAndOneRoundIt) {
  const PlanarSubdivision plane(line({{0.2, 0.2}, {0.8, 0.3}, {0.5, 0.7}, {0.2, 0.2}}));
  EXPECT_NEAR(total_area(plane), 1.0, 1e-12);
  ASSERT_EQ(plane.polygons().size(), 2u);
  EXPECT_NEAR(std::min(plane.area(0), plane.area(1)), 0.5 * (0.6 * 0.5 - 0.3 * 0.1), 1e-14);
}

}  // namespace
}  // namespace cdca
