// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/cut_element.hpp"

#include "core/cells/element_cuts.hpp"
#include "core/cracks/crack_registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>
#include <random>
#include <string>

namespace cdca {
namespace {

using Polylines = std::vector<std::vector<Vec2>>;

const StructuredGrid grid(Vec2(0, 0), Vec2(3, 3), 3, 3);
constexpr GridIndex middle{1, 1};  // its places are (1..2, 1..2)

ElementCuts cuts_of(const Polylines& cracks) {
  CrackRegistry registry;
  for (const auto& points : cracks) registry.add("", points);
  registry.resolve_initial_meetings({Vec2(0, 0), Vec2(3, 3)}, 1e-3);
  return {grid, CrackPaths(grid, registry.cracks())};
}

std::vector<double> part_areas(const CutElement& cut) {
  std::vector<double> areas(std::size_t(cut.parts), 0.0);
  for (const ElementPolygon& p : cut.polygons) areas.at(std::size_t(p.part)) += p.area;
  return areas;
}

struct Cut {
  std::string name;
  Polylines cracks;
  int parts;  ///< of the element in the middle
};

std::ostream& operator<<(std::ostream& out, const Cut& cut) { return out << cut.name; }

const std::vector<Cut> all_cuts{
    {"straight", {{{0.5, 1.2}, {2.5, 1.6}}}, 2},
    {"corner_to_corner", {{{0.5, 0.5}, {2.5, 2.5}}}, 2},
    {"kink_inside", {{{0.5, 1.2}, {1.4, 1.8}, {2.5, 1.5}}}, 2},
    {"in_and_out_by_one_side", {{{0.5, 1.2}, {1.5, 1.5}, {0.5, 1.8}}}, 2},
    {"tip_inside", {{{0.5, 1.2}, {1.4, 1.4}}}, 1},
    {"tip_behind_a_kink", {{{0.5, 1.2}, {1.4, 1.4}, {1.5, 1.8}}}, 1},
    {"tips_side_by_side", {{{0.5, 1.3}, {1.6, 1.3}}, {{2.5, 1.7}, {1.4, 1.7}}}, 1},
    {"tip_on_a_side", {{{0.5, 1.3}, {2, 1.5}}}, 2},
    {"tip_on_a_corner", {{{0.5, 0.5}, {2, 2}}}, 2},
    {"crossing", {{{0.5, 1.3}, {2.5, 1.7}}, {{1.4, 0.5}, {1.5, 2.5}}}, 4},
    {"touching", {{{0.5, 1.3}, {2.5, 1.7}}, {{1.4, 2.5}, {1.5, 1.5}}}, 3},
    {"touching_a_crack_that_ends", {{{0.5, 1.5}, {1.7, 1.5}}, {{1.4, 0.5}, {1.4, 1.5}}}, 2},
    {"meeting", {{{0.5, 1.3}, {1.5, 1.5}}, {{2.5, 1.4}, {1.5, 1.5}}, {{1.6, 2.5}, {1.5, 1.5}}}, 3},
    {"three_that_cross",
     {{{0.5, 1.3}, {2.5, 1.4}}, {{1.2, 0.5}, {1.7, 2.5}}, {{1.8, 0.5}, {1.3, 2.5}}},
     7},
    {"along_a_side", {{{0.5, 1}, {2.5, 1}}}, 1},
    {"along_half_a_side", {{{0.5, 1}, {1.5, 1}}}, 1},
    {"along_a_side_then_across", {{{0.5, 1}, {1.4, 1}, {1.6, 2.5}}}, 2},
    {"two_parallel", {{{0.5, 1.3}, {2.5, 1.3}}, {{0.5, 1.6}, {2.5, 1.6}}}, 3},
    {"elsewhere", {{{0.2, 0.2}, {0.8, 0.3}}}, 1},
};

class CutElementTest : public ::testing::TestWithParam<Cut> {};

TEST_P(CutElementTest, CountsParts) {
  EXPECT_EQ(cuts_of(GetParam().cracks).parts(middle), GetParam().parts);
}

/// Does not depend on which way the grid and the cracks are turned.
TEST_P(CutElementTest, PartsAreTheSameInEveryPosition) {
  std::vector<double> areas = part_areas(cut_element(cuts_of(GetParam().cracks).paths(), middle));
  std::sort(areas.begin(), areas.end());
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 1.0, 1e-12);
  for (int position = 1; position < 8; ++position) {
    Polylines cracks = GetParam().cracks;
    for (auto& points : cracks) {
      for (Vec2& p : points) {
        if (position & 1) p.x() = 3 - p.x();
        if (position & 2) p.y() = 3 - p.y();
        if (position & 4) std::swap(p.x(), p.y());
      }
      if (position & 1) std::reverse(points.begin(), points.end());
    }
    std::vector<double> turned = part_areas(cut_element(cuts_of(cracks).paths(), middle));
    std::sort(turned.begin(), turned.end());
    ASSERT_EQ(turned.size(), areas.size()) << "position " << position;
    for (std::size_t k = 0; k < areas.size(); ++k) EXPECT_NEAR(turned[k], areas[k], 1e-12);
  }
}

void expect_faces_between_their_parts(const ElementCuts& cuts, GridIndex e) {
  for (const CrackFace& f : cuts.faces_of(e)) {
    const Vec2 at = 0.5 * (f.from + f.to), left = turned_left(f.to - f.from).normalized();
    EXPECT_EQ(cuts.part_at(f.plus_element, at + 1e-6 * left), f.plus_part);
    EXPECT_EQ(cuts.part_at(f.minus_element, at - 1e-6 * left), f.minus_part);
  }
}

TEST_P(CutElementTest, FacesHaveTheirPlusPartOnTheLeftOfTheCrack) {
  const ElementCuts cuts = cuts_of(GetParam().cracks);
  expect_faces_between_their_parts(cuts, middle);
  for (const CrackFace& f : cuts.faces_of(middle)) {
    const auto& points = GetParam().cracks[std::size_t(f.crack)];
    const Vec2 d = points[std::size_t(f.segment) + 1] - points[std::size_t(f.segment)];
    EXPECT_NEAR((f.to - f.from).normalized().dot(d.normalized()), 1.0, 1e-9);
  }
}

TEST_P(CutElementTest, SidesAreCoveredOnce) {
  const ElementCuts cuts = cuts_of(GetParam().cracks);
  for (std::size_t s = 0; s < 4; ++s) {
    double end = 0.0;
    for (const SidePortion& p : cuts.side(middle, s)) {
      EXPECT_EQ(p.t0, end);
      EXPECT_LT(p.t0, p.t1);
      EXPECT_LT(p.part, cuts.parts(middle));
      EXPECT_EQ(p.closed, p.step >= 0);
      end = p.t1;
    }
    EXPECT_EQ(end, 1.0);
  }
}

TEST_P(CutElementTest, PortionsBelongToThePartInsideThem) {
  const ElementCuts cuts = cuts_of(GetParam().cracks);
  const CutElement* cut = cuts.find(middle);
  if (!cut) return;  // the crack is elsewhere
  for (std::size_t s = 0; s < 4; ++s) {
    for (const SidePortion& p : cut->sides[s]) {
      const double t = 0.5 * (p.t0 + p.t1), in = 1e-7;
      const Vec2 near[4] = {{t, in}, {1 - in, t}, {t, 1 - in}, {in, t}};
      EXPECT_EQ(cut->part_at(near[s]), p.part) << "side " << s << ", " << t;
    }
  }
}

TEST_P(CutElementTest, OpenAndClosedContactsCoverEverySideBetweenElements) {
  const ElementCuts cuts = cuts_of(GetParam().cracks);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 2; ++i) {
      double beside = 0.0, above = 0.0;
      for (const SideContact& c : contacts(cuts.side({i, j}, 1), cuts.side({i + 1, j}, 3)))
        beside += c.t1 - c.t0;
      for (const SideContact& c : contacts(cuts.side({j, i}, 2), cuts.side({j, i + 1}, 0)))
        above += c.t1 - c.t0;
      EXPECT_NEAR(beside, 1.0, 1e-8);
      EXPECT_NEAR(above, 1.0, 1e-8);
    }
}

INSTANTIATE_TEST_SUITE_P(Cuts, CutElementTest, ::testing::ValuesIn(all_cuts),
                         [](const auto& test) { return test.param.name; });

TEST(CutElementAreas, AreThoseOfTheParts) {
  const ElementCuts cuts = cuts_of({{{1, 1.2}, {2, 1.6}}});
  const auto areas = part_areas(*cuts.find(middle));
  EXPECT_NEAR(areas[std::size_t(cuts.part_at(middle, Vec2(1.5, 1.1)))], 0.4, 1e-14);
  EXPECT_NEAR(areas[std::size_t(cuts.part_at(middle, Vec2(1.5, 1.9)))], 0.6, 1e-14);
}

TEST(CutElementWithATip, HasAFaceInsideOnePart) {
  const ElementCuts cuts = cuts_of({{{0.5, 1.5}, {1.4, 1.5}}});
  const CutElement* cut = cuts.find(middle);
  ASSERT_EQ(cut->faces.size(), 1u) << "the line ahead of the tip is no face";
  EXPECT_EQ(cut->faces[0].plus, cut->faces[0].minus);
  EXPECT_TRUE(cut->faces[0].to.isApprox(Vec2(0.4, 0.5), 1e-14));
  EXPECT_EQ(cut->polygons.size(), 2u);
}

TEST(CutElementSlivers, JoinThePartAcrossTheCrackWhichRunsRoundThem) {
  // cuts the corner at (1, 1) off with legs of 0.01: 5e-5 of the element
  const ElementCuts cuts = cuts_of({{{0.51, 1.5}, {1.51, 0.5}}});
  const CutElement* cut = cuts.find(middle);
  EXPECT_EQ(cut->parts, 1);
  EXPECT_TRUE(cut->faces.empty());
  for (const std::size_t side : {std::size_t(0), std::size_t(3)}) {
    ASSERT_EQ(cut->sides[side].size(), 2u);
    EXPECT_TRUE(cut->sides[side][0].closed);
    EXPECT_NEAR(cut->sides[side][0].t1, 0.01, 1e-12);
    EXPECT_FALSE(cut->sides[side][1].closed);
  }
  EXPECT_NEAR(part_areas(*cut)[0], 1.0, 1e-12) << "nothing is lost";
}

TEST(CutElementSlivers, AreThoseBelowTheLimitOnly) {
  for (const double leg : {0.5, 0.9, 1.1, 2.0}) {
    const double t = leg * std::sqrt(2 * smallest_polygon);
    const ElementCuts cuts = cuts_of({{Vec2(0.5 + t, 1.5), Vec2(1.5 + t, 0.5)}});
    EXPECT_EQ(cuts.parts(middle), leg < 1 ? 1 : 2) << t;
  }
}

TEST(CutElementSlivers, MakeOneCrackOfTwoThatAreTooClose) {
  const ElementCuts cuts = cuts_of({{{0, 1.5}, {3, 1.5}}, {{0, 1.50005}, {3, 1.50005}}});
  const CutElement* cut = cuts.find(middle);
  EXPECT_EQ(cut->parts, 2);
  const auto areas = part_areas(*cut);
  EXPECT_NEAR(areas[0], 0.5, 1e-4);
  EXPECT_NEAR(areas[0] + areas[1], 1.0, 1e-12);
}

TEST(CutElementSlivers, ThinLayerAlongASideLeavesItClosed) {
  const ElementCuts cuts = cuts_of({{{0, 1.00005}, {3, 1.00005}}});
  EXPECT_EQ(cuts.parts(middle), 1);
  const auto found = contacts(cuts.side({1, 0}, 2), cuts.side(middle, 0));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].open);
  EXPECT_NEAR(found[0].t1 - found[0].t0, 1.0, 1e-12);
}

TEST(CutElementSlivers, OfTwoElementsStayJoined) {
  // the layer has changed sides in both elements, so nothing lies between its two halves
  const ElementCuts cuts = cuts_of({{{0, 1.00005}, {3, 1.00005}}});
  double open = 0.0;
  for (const SideContact& c : contacts(cuts.side({0, 1}, 1), cuts.side(middle, 3)))
    if (c.open) open += c.t1 - c.t0;
  EXPECT_NEAR(open, 1.0, 1e-12);
}

TEST(ContactsTest, WholeSidesMeetOpenly) {
  const std::vector<SidePortion> whole{SidePortion{}};
  const auto found = contacts(whole, whole);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].open);
  EXPECT_EQ(found[0].t1 - found[0].t0, 1.0);
}

SidePortion portion(double t0, double t1, int part, int step = -1) {
  SidePortion p;
  p.t0 = t0;
  p.t1 = t1;
  p.part = part;
  p.closed = step >= 0;
  p.step = step;
  return p;
}

TEST(ContactsTest, PortionsAreLaidOverEachOther) {
  const auto found = contacts({portion(0, 0.3, 5), portion(0.3, 1, 6)},
                              {portion(0, 0.3, 1), portion(0.3, 0.8, 2, 9), portion(0.8, 1, 3)});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[1].first, 6);
  EXPECT_EQ(found[1].second, 2);
  EXPECT_FALSE(found[1].open);
  EXPECT_EQ(found[1].step, 9);
  EXPECT_TRUE(found[0].open && found[2].open);
  EXPECT_EQ(found[2].t0, 0.8);
}

TEST(ContactsTest, CrackThatEndsOnTheSideClosesItUpToThere) {
  const std::vector<SidePortion> side{portion(0, 0.4, 0, 9), portion(0.4, 1, 0)};
  const auto found = contacts(side, side);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_FALSE(found[0].open);
  EXPECT_TRUE(found[1].open);
}

TEST(ContactsTest, CrackThroughTheSideParts) {
  const ElementCuts cuts = cuts_of({{{0.5, 1.2}, {2.5, 1.6}}});
  const auto found = contacts(cuts.side(middle, 1), cuts.side({2, 1}, 3));
  ASSERT_EQ(found.size(), 2u);
  for (const SideContact& c : found) EXPECT_TRUE(c.open);
  EXPECT_NE(found[0].first, found[1].first);
  EXPECT_NEAR(found[0].t1, 0.5, 1e-12);
}

/// Both sides of each face, over all elements: the crack.
double length_of_faces(const ElementCuts& cuts) {
  double sum = 0.0;
  for (GlobalId id = 0; id < grid.element_count(); ++id)
    for (const CrackFace& f : cuts.faces_of(grid.element_index(id))) sum += (f.to - f.from).norm();
  return sum;
}

TEST(CrackFacesTest, AddUpToTheCracks) {
  EXPECT_NEAR(length_of_faces(cuts_of({{{0.5, 1.2}, {2.5, 1.6}}})), std::hypot(2, 0.4), 1e-12);
  EXPECT_NEAR(length_of_faces(cuts_of({{{0.5, 0.5}, {2.5, 2.5}}, {{0.4, 2.3}, {2.2, 0.7}}})),
              std::hypot(2, 2) + std::hypot(1.8, 1.6), 1e-12);
  EXPECT_NEAR(length_of_faces(cuts_of({{{0.5, 1.2}, {1.4, 1.8}, {1.1, 2.4}}})),
              std::hypot(0.9, 0.6) + std::hypot(0.3, 0.6), 1e-12);
}

TEST(CrackFacesTest, LieOnGridLinesToo) {
  const ElementCuts cuts = cuts_of({{{0, 1}, {2, 1}}, {{2, 3}, {2, 1}}});
  EXPECT_NEAR(length_of_faces(cuts), 4.0, 1e-12);
  for (GlobalId id = 0; id < grid.element_count(); ++id)
    expect_faces_between_their_parts(cuts, grid.element_index(id));
}

TEST(CrackFacesTest, ReachATipInTheMiddleOfASide) {
  EXPECT_NEAR(length_of_faces(cuts_of({{{0, 1}, {1.5, 1}}})), 1.5, 1e-12);
  EXPECT_NEAR(length_of_faces(cuts_of({{{2, 0.4}, {2, 2.7}}})), 2.3, 1e-12);
}

TEST(CrackFacesTest, StayOnTheGridLineWhenTheCrackLeavesItForAnElement) {
  const double bent = std::hypot(0.3, 0.4);
  EXPECT_NEAR(length_of_faces(cuts_of({{{0, 1}, {1.3, 1}, {1.6, 1.4}}})), 1.3 + bent, 1e-12);
}

TEST(CrackFacesTest, RemainWhereTwoTipsLookAtEachOther) {
  EXPECT_NEAR(length_of_faces(cuts_of({{{0.5, 1.5}, {1.4, 1.5}}, {{2.5, 1.5}, {1.6, 1.5}}})), 1.8,
              1e-12);
}

TEST(RandomCracks, KeepElementsWhole) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> any(0.05, 2.95);
  for (int k = 0; k < 500; ++k) {
    Polylines cracks(1 + std::size_t(k % 3));
    for (auto& points : cracks)
      for (int n = 0; n < 2 + k % 2; ++n) points.emplace_back(any(random), any(random));
    const ElementCuts cuts = cuts_of(cracks);
    for (GlobalId id = 0; id < grid.element_count(); ++id) {
      const GridIndex e = grid.element_index(id);
      const CutElement* cut = cuts.find(e);
      if (!cut) continue;
      double area = 0.0;
      for (const ElementPolygon& p : cut->polygons) {
        EXPECT_GT(p.area, 0.0);
        area += p.area;
      }
      EXPECT_NEAR(area, 1.0, 1e-12);
      for (const double a : part_areas(*cut)) EXPECT_GE(a, smallest_polygon);
    }
    if (HasFailure()) FAIL() << "case " << k;
  }
}

}  // namespace
}  // namespace cdca
