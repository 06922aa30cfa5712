// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/meetings.hpp"

#include "core/cracks/segments.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace cdca {
namespace {

const Rectangle body{Vec2(0, 0), Vec2(20, 16)};
constexpr double touch = 1e-3;
using Polylines = std::vector<std::vector<Vec2>>;

CrackRegistry registry_of(const Polylines& cracks) {
  CrackRegistry registry;
  for (const auto& points : cracks) registry.add("", points);
  registry.resolve_initial_meetings(body, touch);
  return registry;
}

/// A step of a tip: crack, end and the vector that it would grow by.
struct Step {
  int crack;
  int end;
  Vec2 by;
};

std::vector<Increment> resolved(const CrackRegistry& registry, const std::vector<Step>& steps) {
  std::vector<Increment> incs;
  for (const Step& s : steps) {
    const Vec2 from = registry.cracks()[std::size_t(s.crack)].end_point(s.end);
    incs.push_back({s.crack, s.end, from, from + s.by});
  }
  return resolve_meetings(registry, body, touch, incs);
}

std::vector<Increment> resolved(const Polylines& cracks, const std::vector<Step>& steps) {
  return resolved(registry_of(cracks), steps);
}

Vec2 polar(double degrees, double length) {
  const double a = degrees * std::numbers::pi / 180;
  return {length * std::cos(a), length * std::sin(a)};
}

void expect_end(const Increment& inc, const Vec2& at, TipState state, int partner = -1,
                int partner_end = -1) {
  EXPECT_LT((inc.to - at).norm(), 1e-12) << "ends at " << inc.to.transpose();
  EXPECT_EQ(inc.state, state) << name_of(inc.state);
  EXPECT_EQ(inc.partner, partner);
  EXPECT_EQ(inc.partner_end, partner_end);
}

void expect_free(const Increment& inc, const Vec2& by) {
  expect_end(inc, inc.from + by, TipState::active);
}

TEST(BoundaryMeeting, TheNearestRimPointEndsTheCrack) {
  const auto incs = resolved({{{15, 7}, {18.5, 7}}}, {{0, 1, polar(20, 2)}});
  expect_end(incs[0], Vec2(20, 7), TipState::boundary);
}

TEST(BoundaryMeeting, ARimFartherThanTheStepIsNotReached) {
  expect_free(resolved({{{15, 7}, {17.99, 7}}}, {{0, 1, Vec2(2, 0)}})[0], Vec2(2, 0));
}

TEST(BoundaryMeeting, ARimAsideOfTheStepIsPassed) {
  // 1 from the upper rim, which lies 70 degrees off
  expect_free(resolved({{{5, 15}, {8, 15}}}, {{0, 1, polar(20, 2)}})[0], polar(20, 2));
  // 40 degrees off it counts
  expect_end(resolved({{{5, 15}, {8, 15}}}, {{0, 1, polar(50, 2)}})[0], Vec2(8, 16),
             TipState::boundary);
}

TEST(BoundaryMeeting, AStepThatLeavesTheBodyEndsWhereItDoes) {
  const auto incs = resolved({{{5, 15.5}, {8, 15.5}}}, {{0, 1, polar(20, 2)}});
  expect_end(incs[0], Vec2(8 + 0.5 / std::tan(20 * std::numbers::pi / 180), 16),
             TipState::boundary);
}

TEST(BoundaryMeeting, AStepThatEndsWithinTouchOfTheRimReachesIt) {
  const auto incs = resolved({{{5, 15}, {8, 15.2}}}, {{0, 1, Vec2(3, 0.7996)}});
  expect_end(incs[0], Vec2(11, 16), TipState::boundary);
}

TEST(BoundaryMeeting, TheRimJustLeftDoesNotCountForNearness) {
  // an edge crack that starts steeply along the rim and turns back towards it
  const Polylines cracks{{{0, 7}, {0.5, 8}}};
  expect_free(resolved(cracks, {{0, 1, polar(140, 0.6)}})[0], polar(140, 0.6));
  const auto back = resolved(cracks, {{0, 1, polar(140, 1)}});
  EXPECT_EQ(back[0].state, TipState::boundary) << "it is met where it is crossed";
  EXPECT_NEAR(back[0].to.y(), 8 + 0.5 * std::tan(40 * std::numbers::pi / 180), 1e-12);
}

TEST(BoundaryMeeting, CrackMouthsNearerThanTouchAreOne) {
  const auto incs =
      resolved({{{20, 7.0004}, {15, 7.3}}, {{15, 6}, {18.5, 7}}}, {{1, 1, Vec2(2, 0)}});
  expect_end(incs[0], Vec2(20, 7.0004), TipState::boundary);
}

TEST(Coalescence, AtTheFaceThatIsCrossed) {
  const auto incs = resolved({{{5, 4}, {9, 4}}, {{9, 2}, {12, 8}}}, {{0, 1, polar(-5, 3)}});
  EXPECT_EQ(incs[0].state, TipState::coalesced);
  EXPECT_EQ(incs[0].partner, 1);
  EXPECT_LT(std::abs(cross(Vec2(3, 6), incs[0].to - Vec2(9, 2))), 1e-12);
}

TEST(Coalescence, AtTheNearestPointOfAFaceAhead) {
  const auto incs = resolved({{{5, 4}, {9, 4}}, {{10.5, 0}, {10.5, 8}}}, {{0, 1, polar(50, 2)}});
  expect_end(incs[0], Vec2(10.5, 4), TipState::coalesced, 1);
}

TEST(Coalescence, CracksThatPassSideBySidePass) {
  const Polylines cracks{{{3, 4}, {6, 4}}, {{2, 4.3}, {12, 4.3}}};
  expect_free(resolved(cracks, {{0, 1, Vec2(2, 0)}})[0], Vec2(2, 0));
  const Polylines side_by_side{{{3, 4}, {6, 4}}, {{3, 4.3}, {6, 4.3}}};
  const auto incs = resolved(side_by_side, {{0, 1, Vec2(2, 0)}, {1, 1, Vec2(2, 0)}});
  expect_free(incs[0], Vec2(2, 0));
  expect_free(incs[1], Vec2(2, 0));
}

TEST(Coalescence, AGrazedFaceIsMetWhereItIsCrossed) {
  // 3 degrees to the face, which lies far less than a step away
  const auto incs = resolved({{{3, 4}, {6, 4.2}}, {{2, 4.3}, {12, 4.3}}}, {{0, 1, polar(3, 2.5)}});
  expect_end(incs[0], Vec2(6 + 0.1 / std::tan(3 * std::numbers::pi / 180), 4.3),
             TipState::coalesced, 1);
}

TEST(Coalescence, AStepThatEndsWithinTouchOfAFaceEndsOnIt) {
  const auto incs =
      resolved({{{3, 4}, {6, 4.2}}, {{2, 4.3}, {12, 4.3}}}, {{0, 1, Vec2(2, 0.0995)}});
  expect_end(incs[0], Vec2(8, 4.3), TipState::coalesced, 1);
}

TEST(Coalescence, VerticesNearerThanTouchAreMetThemselves) {
  const Polylines cracks{{{3, 4}, {6, 4}}, {{7, 2}, {7.0, 4.0007}, {8, 6}}};
  const auto incs = resolved(cracks, {{0, 1, Vec2(2, 0)}});
  EXPECT_EQ(incs[0].to, Vec2(7.0, 4.0007));
  EXPECT_EQ(incs[0].state, TipState::coalesced);
}

TEST(Coalescence, TheWayToANearFaceEndsAtWhatItCrosses) {
  // the face at x = 8 lies ahead, the slanted one off its way but across the way to the face
  const Polylines cracks{{{3, 4}, {6, 4}}, {{8, 3.0}, {8, 5.9}}, {{7.3, 4.1}, {6.5, 3.0}}};
  const auto incs = resolved(cracks, {{0, 1, polar(50, 2.5)}});
  EXPECT_EQ(incs[0].partner, 2);
  EXPECT_NEAR(incs[0].to.y(), 4.0, 1e-12);
}

TEST(Coalescence, ACrackGrowsIntoItself) {
  const Polylines hook{{{4, 4}, {8, 4}, {8, 6}, {6, 6}}};
  // straight down onto its first segment
  expect_end(resolved(hook, {{0, 1, polar(-80, 2.5)}})[0], Vec2(6, 4), TipState::coalesced, 0);
  // across it, aside of what is ahead
  const auto crossing = resolved(hook, {{0, 1, Vec2(-1.9, -2.5)}});
  EXPECT_EQ(crossing[0].state, TipState::coalesced);
  EXPECT_EQ(crossing[0].partner, 0);
  // free as long as nothing of it is near
  expect_free(resolved(hook, {{0, 1, Vec2(0, -1.9)}})[0], Vec2(0, -1.9));
}

TEST(Coalescence, TheJunctionJustLeftDoesNotCountForNearness) {
  // a branch that leaves the face under 30 degrees and turns back to it
  const Polylines cracks{{{2, 4}, {12, 4}}, {{6, 4}, {6.8, 4.4}}};
  expect_free(resolved(cracks, {{1, 1, polar(-35, 0.5)}})[0], polar(-35, 0.5));
  const auto across = resolved(cracks, {{1, 1, polar(-35, 1)}});
  EXPECT_EQ(across[0].state, TipState::coalesced) << "it is met where it is crossed";
  EXPECT_NEAR(across[0].to.y(), 4, 1e-12);
}

TEST(Coalescence, ATipArrivesAtAJunction) {
  const Polylines tee{{{2, 8}, {12, 8}}, {{7, 12}, {7, 8}}, {{3, 4}, {7, 6.5}}};
  const auto incs = resolved(tee, {{2, 1, Vec2(0.5, 1.7)}});
  EXPECT_EQ(incs[0].to, Vec2(7, 8));
  EXPECT_EQ(incs[0].state, TipState::coalesced);
}

TEST(Connection, CrossingStepsBothEndAtTheCrossing) {
  const auto incs =
      resolved({{{2, 4}, {5, 4}}, {{8, 1}, {6.2, 2.8}}}, {{0, 1, Vec2(2, 0)}, {1, 1, Vec2(-1, 2)}});
  const Vec2 at(5.6, 4);
  expect_end(incs[0], at, TipState::connected, 1, 1);
  expect_end(incs[1], at, TipState::connected, 0, 1);
}

TEST(Connection, HeadOnTipsMeetMidway) {
  for (const double gap : {0.5, 1.7, 2.5, 3.9}) {
    const auto incs = resolved({{{2, 4}, {5, 4}}, {{9 + gap, 4}, {5 + gap, 4}}},
                               {{0, 1, Vec2(2, 0)}, {1, 1, Vec2(-2, 0)}});
    expect_end(incs[0], Vec2(5 + gap / 2, 4), TipState::connected, 1, 1);
    expect_end(incs[1], Vec2(5 + gap / 2, 4), TipState::connected, 0, 1);
  }
  const auto apart =
      resolved({{{2, 4}, {5, 4}}, {{13, 4}, {9.01, 4}}}, {{0, 1, Vec2(2, 0)}, {1, 1, Vec2(-2, 0)}});
  expect_free(apart[0], Vec2(2, 0));
  expect_free(apart[1], Vec2(-2, 0));
}

TEST(Connection, HeadOnTipsShareTheGapByTheirSteps) {
  const auto incs =
      resolved({{{2, 4}, {5, 4}}, {{9, 4}, {7, 4}}}, {{0, 1, Vec2(3, 0)}, {1, 1, Vec2(-1, 0)}});
  expect_end(incs[0], Vec2(6.5, 4), TipState::connected, 1, 1);
  expect_end(incs[1], Vec2(6.5, 4), TipState::connected, 0, 1);
}

TEST(Connection, OffsetTipsMeetWhenTheirStepsBringThemNear) {
  const auto tips = [](double offset) {
    return resolved({{{2, 4}, {5, 4}}, {{11, 4 + offset}, {8, 4 + offset}}},
                    {{0, 1, Vec2(2, 0)}, {1, 1, Vec2(-2, 0)}});
  };
  // gap along the steps 3, of 4: they meet up to an offset of 1 / sqrt(3)
  EXPECT_EQ(tips(0.57)[0].state, TipState::connected);
  EXPECT_EQ(tips(0.57)[1].state, TipState::connected);
  EXPECT_LT((tips(0.57)[0].to - Vec2(6.5, 4.285)).norm(), 1e-12);
  expect_free(tips(0.59)[0], Vec2(2, 0));
  expect_free(tips(0.59)[1], Vec2(-2, 0));
}

TEST(Connection, ATipThatDoesNotGrowIsMetAsATip) {
  const auto incs = resolved({{{2, 4}, {5, 4}}, {{10, 4.2}, {6, 4.2}}}, {{0, 1, Vec2(2, 0)}});
  expect_end(incs[0], Vec2(6, 4.2), TipState::connected, 1, 1);
}

TEST(Connection, AGrowingTipLeavesItsPlaceAsAFace) {
  const auto incs =
      resolved({{{2, 4}, {5, 4}}, {{6, 1}, {6, 4}}}, {{0, 1, Vec2(2, 0)}, {1, 1, Vec2(0, 2)}});
  expect_end(incs[0], Vec2(6, 4), TipState::coalesced, 1);
  expect_free(incs[1], Vec2(0, 2));
}

TEST(Connection, TheTipsOfOneCrackMeet) {
  const Polylines c{{{6, 5}, {4, 4}, {4, 8}, {6, 7}}};
  const auto incs = resolved(c, {{0, 0, Vec2(0, 1.5)}, {0, 1, Vec2(0, -1.5)}});
  expect_end(incs[0], Vec2(6, 6), TipState::connected, 0, 1);
  expect_end(incs[1], Vec2(6, 6), TipState::connected, 0, 0);
  CrackRegistry registry = registry_of(c);
  apply_increments(incs, touch, {1, 0}, registry);
  EXPECT_EQ(registry.active_tips(), 0);
  EXPECT_EQ(registry.cracks()[0].points.front(), registry.cracks()[0].points.back());
}

TEST(Connection, OneTipOfACrackMeetsItsOther) {
  const Polylines c{{{6, 5}, {4, 4}, {4, 8}, {6, 7}}};
  expect_end(resolved(c, {{0, 1, Vec2(0, -2.5)}})[0], Vec2(6, 5), TipState::connected, 0, 0);
}

TEST(Coalescence, WithinTouchTheEndMovesInsteadOfAStep) {
  // a tip that has come within touch of a face without having ended on it
  CrackRegistry registry = registry_of({{{2, 2}, {4, 3}}, {{6, 2}, {6, 5}}});
  registry.advance(0, 1, Vec2(5.9995, 3), TipState::active, -1, {1, 0});
  const auto incs = resolved(registry, {{0, 1, Vec2(1, 0)}});
  apply_increments(incs, touch, {2, 0}, registry);
  EXPECT_EQ(registry.cracks()[0].points, (std::vector<Vec2>{{2, 2}, {4, 3}, {6, 3}}));
  EXPECT_EQ(registry.cracks()[0].born, (std::vector<GrowthTime>{{0, 0}, {1, 0}}));
  EXPECT_EQ(registry.cracks()[0].ends[1].state, TipState::coalesced);
}

TEST(Order, AStepCutShortMeetsNothingFurtherOn) {
  // 0 goes right; 1 crosses it early, 2 would cross it later
  const Polylines cracks{{{2, 4}, {5, 4}}, {{5.5, 6}, {5.5, 5}}, {{6.5, 2}, {6.5, 3}}};
  const auto incs =
      resolved(cracks, {{0, 1, Vec2(2, 0)}, {1, 1, Vec2(0, -1.6)}, {2, 1, Vec2(0, 1.6)}});
  expect_end(incs[0], Vec2(5.5, 4), TipState::connected, 1, 1);
  expect_end(incs[1], Vec2(5.5, 4), TipState::connected, 0, 1);
  expect_free(incs[2], Vec2(0, 1.6));
}

TEST(Order, AStepEndsOnOneThatHasBeenCutShort) {
  // 0 and 1 meet at 1.0; 2 arrives later, at 0.5 of the way of 0
  const Polylines cracks{{{2, 4}, {5, 4}}, {{6, 6}, {6, 5}}, {{5.5, 1}, {5.5, 2.2}}};
  const auto incs =
      resolved(cracks, {{0, 1, Vec2(2, 0)}, {1, 1, Vec2(0, -1.6)}, {2, 1, Vec2(0, 2.4)}});
  expect_end(incs[0], Vec2(6, 4), TipState::connected, 1, 1);
  expect_end(incs[1], Vec2(6, 4), TipState::connected, 0, 1);
  expect_end(incs[2], Vec2(5.5, 4), TipState::coalesced, 0);
}

TEST(Order, AFaceThatComesFirstHidesTheOtherStep) {
  const Polylines cracks{{{2, 4}, {5, 4}}, {{6, 1}, {6, 3}}, {{5.2, 3}, {5.2, 4.1}}};
  const auto incs = resolved(cracks, {{0, 1, Vec2(2, 0)}, {1, 1, Vec2(0, 1.2)}});
  expect_end(incs[0], Vec2(5.2, 4), TipState::coalesced, 2);
  expect_free(incs[1], Vec2(0, 1.2));
}

TEST(Order, ThreeStepsMeetInOnePlace) {
  Polylines star;
  std::vector<Step> steps;
  for (int k = 0; k < 3; ++k) {
    const Vec2 out = polar(90 + 120 * k, 1);
    star.push_back({Vec2(8, 8) + 4 * out, Vec2(8, 8) + out});
    steps.push_back({k, 1, -1.5 * out});
  }
  const auto incs = resolved(star, steps);
  for (const Increment& inc : incs) {
    EXPECT_NE(inc.state, TipState::active);
    EXPECT_LT((inc.to - Vec2(8, 8)).norm(), touch);
    EXPECT_EQ(inc.to, incs[0].to) << "one place, to the last bit";
  }
}

TEST(Order, DoesNotDependOnThatOfTheInput) {
  std::mt19937 random(3);
  const Polylines cracks{
      {{2, 4}, {5, 4}}, {{6, 6}, {6, 5}}, {{5.5, 1}, {5.5, 2.2}}, {{9, 4}, {7, 4}}};
  std::vector<Step> steps{{0, 1, Vec2(2, 0)},
                          {1, 1, Vec2(0, -1.6)},
                          {2, 1, Vec2(0, 2.4)},
                          {3, 1, Vec2(-1.5, 0)},
                          {3, 0, Vec2(1.5, 0)}};
  const auto first = resolved(cracks, steps);
  for (int k = 0; k < 20; ++k) {
    std::shuffle(steps.begin(), steps.end(), random);
    const auto again = resolved(cracks, steps);
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(again[i].to, first[i].to);
      EXPECT_EQ(again[i].state, first[i].state);
      EXPECT_EQ(again[i].partner, first[i].partner);
    }
  }
}

/// Random cracks of which many touch.
CrackRegistry crowd(std::mt19937& random) {
  std::uniform_real_distribution<double> any(0, 1);
  const auto between = [&](double a, double b) { return a + (b - a) * any(random); };
  Polylines cracks;
  const int count = 4 + int(20 * any(random));
  for (int k = 0; k < count; ++k) {
    std::vector<Vec2> points{Vec2(between(1, 19), between(1, 15))};
    double angle = between(0, 360);
    for (int s = 0; s < 1 + k % 3; ++s, angle += between(-60, 60))
      points.push_back(points.back() + polar(angle, between(0.5, 2)));
    const bool inside = std::all_of(points.begin(), points.end(), [](const Vec2& p) {
      return p.x() > 0.1 && p.x() < 19.9 && p.y() > 0.1 && p.y() < 15.9;
    });
    if (inside) cracks.push_back(points);
  }
  return registry_of(cracks);
}

std::vector<Step> random_steps(const CrackRegistry& registry, std::mt19937& random) {
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<Step> steps;
  for (std::size_t k = 0; k < registry.cracks().size(); ++k) {
    for (int end = 0; end < 2; ++end) {
      const Crack& crack = registry.cracks()[k];
      if (crack.ends[std::size_t(end)].state != TipState::active || any(random) < 0.2) continue;
      const double turn = (140 * any(random) - 70) * std::numbers::pi / 180;
      const Vec2 direction = Eigen::Rotation2Dd(turn) * crack.end_tangent(end);
      steps.push_back({int(k), end, (0.5 + 1.5 * any(random)) * direction});
    }
  }
  return steps;
}

/// The new segment crosses nothing; its tip touches nothing, or it lies on what it has met.
void expect_clean(const CrackRegistry& registry, const Increment& i) {
  const Crack& own = registry.cracks()[std::size_t(i.crack)];
  const std::size_t new_one = i.end == 0 ? 0 : own.segments() - 1;
  bool on_partner = i.state == TipState::active;
  if (i.state == TipState::boundary)
    on_partner = i.to.x() == 0 || i.to.x() == 20 || i.to.y() == 0 || i.to.y() == 16;
  for (std::size_t k = 0; k < registry.cracks().size(); ++k) {
    const auto& p = registry.cracks()[k].points;
    for (std::size_t s = 0; s + 1 < p.size(); ++s) {
      if (int(k) == i.crack && s == new_one) continue;
      const double off = (foot_on(p[s], p[s + 1], i.to) - i.to).norm();
      if (int(k) == i.partner) on_partner = on_partner || off < 1e-9;
      const bool just_behind = int(k) == i.crack && (p[s] == i.from || p[s + 1] == i.from);
      if (i.state == TipState::active && !just_behind) {
        EXPECT_GT(off, touch) << "tip of " << i.crack << " on " << k;
      }
      const auto hit = crossing_of(i.from, i.to, p[s], p[s + 1]);
      if (!hit) continue;
      double from_ends = 1e9;
      for (const Vec2& x : {i.from, i.to, p[s], p[s + 1]})
        from_ends = std::min(from_ends, (i.from + hit->on_first * (i.to - i.from) - x).norm());
      EXPECT_LT(from_ends, 2 * touch) << i.crack << " crosses " << k;
    }
  }
  EXPECT_TRUE(on_partner) << i.crack << " is " << name_of(i.state) << " with nothing";
}

TEST(MeetingsOfACrowd, LeaveACleanNetwork) {
  int met = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    CrackRegistry registry = crowd(random);
    for (int cycle = 1; cycle <= 5; ++cycle) {
      const auto incs = resolved(registry, random_steps(registry, random));
      apply_increments(incs, touch, {1, cycle}, registry);
      for (const Increment& i : incs) expect_clean(registry, i);
      met += int(std::count_if(incs.begin(), incs.end(),
                               [](const Increment& i) { return i.state != TipState::active; }));
    }
  }
  EXPECT_GT(met, 10000);
}

}  // namespace
}  // namespace cdca
