// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/crack_registry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

namespace cdca {
namespace {

const Rectangle body{Vec2(0, 0), Vec2(10, 8)};
constexpr double tolerance = 1e-3;

CrackRegistry resolved(const std::vector<std::vector<Vec2>>& cracks) {
  CrackRegistry registry;
  for (std::size_t c = 0; c < cracks.size(); ++c) registry.add("c" + std::to_string(c), cracks[c]);
  registry.resolve_initial_meetings(body, tolerance);
  return registry;
}

const CrackEnd& end_of(const CrackRegistry& registry, std::size_t crack, std::size_t end) {
  return registry.cracks()[crack].ends[end];
}

std::vector<Event> events_of(const CrackRegistry& registry, EventKind kind) {
  std::vector<Event> found;
  for (const Event& e : registry.events())
    if (e.kind == kind) found.push_back(e);
  return found;
}

TEST(CrackRegistryTest, CrackInsideTheBodyKeepsTwoTips) {
  const CrackRegistry registry = resolved({{{2, 2}, {4, 3}}});
  EXPECT_EQ(registry.active_tips(), 2);
  EXPECT_TRUE(registry.events().empty());
  EXPECT_EQ(registry.cracks()[0].born, std::vector<GrowthTime>(1));
}

TEST(CrackRegistryTest, EndsNearTheRimMoveOntoIt) {
  const std::vector<std::pair<Vec2, Vec2>> near_and_on{{{0.0005, 4}, {0, 4}},
                                                       {{10.0005, 4}, {10, 4}},
                                                       {{5, -0.0005}, {5, 0}},
                                                       {{5, 7.9995}, {5, 8}}};
  for (const auto& [near, on] : near_and_on) {
    const CrackRegistry registry = resolved({{{5, 4.5}, near}});
    EXPECT_EQ(end_of(registry, 0, 1).state, TipState::boundary);
    EXPECT_EQ(end_of(registry, 0, 0).state, TipState::active);
    EXPECT_EQ(registry.cracks()[0].points.back(), on);
    ASSERT_EQ(registry.events().size(), 1u);
    EXPECT_EQ(registry.events()[0].kind, EventKind::boundary);
    EXPECT_EQ(registry.events()[0].crack, 0);
    EXPECT_EQ(registry.events()[0].end, 1);
    EXPECT_EQ(registry.events()[0].at, on);
  }
}

TEST(CrackRegistryTest, EndsFartherThanTheToleranceTouchNothing) {
  const double away = 1.01 * tolerance;
  const CrackRegistry registry = resolved(
      {{{2, 4}, {6, 4}}, {{4, 4 + away}, {4, 6}}, {{6 + away, 4}, {8, 4}}, {{away, 1}, {3, 1}}});
  EXPECT_EQ(registry.active_tips(), 8);
  EXPECT_TRUE(registry.events().empty());
}

TEST(CrackRegistryTest, ThreeEndsInOnePlaceConnectToAY) {
  const double off = 0.4 * tolerance;
  const CrackRegistry registry =
      resolved({{{5, 4}, {8, 4}}, {{3, 6}, {5 - off, 4}}, {{5, 4 - off}, {3, 2}}});
  EXPECT_EQ(registry.active_tips(), 3);
  const std::size_t ends[3] = {0, 1, 0};
  const Vec2 place = registry.cracks()[0].points.front();
  for (std::size_t c = 0; c < 3; ++c) {
    const CrackEnd& end = end_of(registry, c, ends[c]);
    EXPECT_EQ(end.state, TipState::connected);
    EXPECT_NE(end.partner, int(c));
    EXPECT_GE(end.partner, 0);
    EXPECT_EQ(registry.cracks()[c].end_point(int(ends[c])), place) << "one place, to the last bit";
  }
  EXPECT_EQ(events_of(registry, EventKind::connection).size(), 3u);
  EXPECT_EQ(registry.events().size(), 3u);
}

TEST(CrackRegistryTest, EndOnAFaceCoalesces) {
  const CrackRegistry registry = resolved({{{2, 4}, {4, 4}, {8, 4}}, {{6, 7}, {6, 4.0005}}});
  EXPECT_EQ(end_of(registry, 1, 1).state, TipState::coalesced);
  EXPECT_EQ(end_of(registry, 1, 1).partner, 0);
  EXPECT_EQ(registry.cracks()[1].points.back(), Vec2(6, 4));
  EXPECT_EQ(registry.active_tips(), 3);
  ASSERT_EQ(registry.events().size(), 1u);
  EXPECT_EQ(registry.events()[0].kind, EventKind::coalescence);
  EXPECT_EQ(registry.events()[0].crack, 1);
  EXPECT_EQ(registry.events()[0].partner, 0);
}

TEST(CrackRegistryTest, EndJustBeyondAFaceIsBroughtBack) {
  const CrackRegistry registry = resolved({{{2, 4}, {8, 4}}, {{6, 7}, {6, 3.9995}}});
  EXPECT_EQ(registry.cracks()[1].points.back(), Vec2(6, 4));
  EXPECT_EQ(registry.events().size(), 1u);
}

TEST(CrackRegistryTest, MovingAnEndOntoAFaceIsNoCrossing) {
  // the foot on an oblique face is rounded to one side of it or the other
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.1, 0.9);
  int crossings = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec2 a(1 + any(random), 1 + any(random)), b(7 + any(random), 5 + any(random));
    const Vec2 foot = a + any(random) * (b - a);
    const CrackRegistry registry =
        resolved({{a, b}, {foot + Vec2(-any(random), 1 + any(random)), foot}});
    ASSERT_EQ(end_of(registry, 1, 1).state, TipState::coalesced);
    crossings += int(events_of(registry, EventKind::crossing).size());
  }
  EXPECT_EQ(crossings, 0) << "of 500 touching ends";
}

TEST(CrackRegistryTest, CrossingCracksKeepTheirTips) {
  const CrackRegistry registry = resolved({{{2, 2}, {6, 6}}, {{2, 6}, {6, 2}}, {{2, 3}, {6, 3}}});
  EXPECT_EQ(registry.active_tips(), 6);
  const auto crossings = events_of(registry, EventKind::crossing);
  ASSERT_EQ(crossings.size(), 3u);
  EXPECT_TRUE(crossings[0].at.isApprox(Vec2(4, 4), 1e-14));
  EXPECT_TRUE(crossings[1].at.isApprox(Vec2(3, 3), 1e-14));
  EXPECT_TRUE(crossings[2].at.isApprox(Vec2(5, 3), 1e-14));
  EXPECT_EQ(crossings[2].crack, 1);
  EXPECT_EQ(crossings[2].partner, 2);
}

TEST(CrackRegistryTest, CrossingAtAKinkIsOneEvent) {
  const CrackRegistry registry = resolved({{{2, 4}, {8, 4}}, {{4, 6}, {5, 4}, {5, 2}}});
  const auto crossings = events_of(registry, EventKind::crossing);
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_TRUE(crossings[0].at.isApprox(Vec2(5, 4), 1e-14));
}

TEST(CrackRegistryTest, ThreeCracksThroughOnePointCrossInPairs) {
  const CrackRegistry registry = resolved({{{3, 4}, {7, 4}}, {{5, 2}, {5, 6}}, {{4, 3}, {6, 5}}});
  EXPECT_EQ(registry.active_tips(), 6);
  const auto crossings = events_of(registry, EventKind::crossing);
  ASSERT_EQ(crossings.size(), 3u);
  for (const Event& e : crossings) EXPECT_TRUE(e.at.isApprox(Vec2(5, 4), 1e-14));
}

TEST(CrackRegistryTest, EndsOnAJunctionShareIt) {
  const double off = 0.6 * tolerance;
  const CrackRegistry registry =
      resolved({{{2, 4}, {8, 4}}, {{5, 7}, {5, 4 + off}}, {{3, 7}, {5 - off, 4}}});
  EXPECT_EQ(registry.cracks()[1].points.back(), Vec2(5, 4));
  EXPECT_EQ(registry.cracks()[2].points.back(), Vec2(5, 4));
  for (const std::size_t c : {1U, 2U}) {
    EXPECT_EQ(end_of(registry, c, 1).state, TipState::coalesced);
    EXPECT_EQ(end_of(registry, c, 1).partner, 0);
  }
  EXPECT_EQ(events_of(registry, EventKind::coalescence).size(), 2u);
  EXPECT_EQ(registry.events().size(), 2u);
}

TEST(CrackRegistryTest, EndNearAKinkOfItsPartnerEndsInTheKink) {
  const Vec2 kink(5, 4 + 0.8 * tolerance);
  const CrackRegistry registry = resolved({{{2, 4}, kink, {8, 4}}, {{4, 7}, {5, 4}}});
  EXPECT_EQ(registry.cracks()[1].points.back(), kink);
}

TEST(CrackRegistryTest, ALassoEndsOnItsOwnFace) {
  const CrackRegistry registry = resolved({{{2, 2}, {8, 2}, {8, 6}, {5, 6}, {5, 2.0004}}});
  EXPECT_EQ(end_of(registry, 0, 1).state, TipState::coalesced);
  EXPECT_EQ(end_of(registry, 0, 1).partner, 0);
  EXPECT_EQ(registry.cracks()[0].points.back(), Vec2(5, 2));
  EXPECT_EQ(registry.active_tips(), 1);
  ASSERT_EQ(registry.events().size(), 1u);
  EXPECT_EQ(registry.events()[0].partner, 0);
}

TEST(CrackRegistryTest, ALoopIsConnectedWithItself) {
  const CrackRegistry registry = resolved({{{2, 2}, {8, 2}, {5, 6}, {2.0005, 2}}});
  EXPECT_EQ(registry.active_tips(), 0);
  for (const std::size_t end : {0U, 1U}) {
    EXPECT_EQ(end_of(registry, 0, end).state, TipState::connected);
    EXPECT_EQ(end_of(registry, 0, end).partner, 0);
  }
  EXPECT_EQ(registry.cracks()[0].points.front(), registry.cracks()[0].points.back());
  EXPECT_EQ(events_of(registry, EventKind::connection).size(), 2u);
  EXPECT_EQ(registry.events().size(), 2u);
}

TEST(CrackRegistryTest, ACrackThatCrossesItselfIsACrossing) {
  const CrackRegistry registry = resolved({{{2, 2}, {8, 2}, {8, 6}, {5, 6}, {5, 1}}});
  EXPECT_EQ(registry.active_tips(), 2);
  ASSERT_EQ(registry.events().size(), 1u);
  EXPECT_EQ(registry.events()[0].kind, EventKind::crossing);
  EXPECT_TRUE(registry.events()[0].at.isApprox(Vec2(5, 2), 1e-14));
}

TEST(CrackRegistryTest, CracksThatRunIntoEachOtherSideBySideMeetOnce) {
  // the second ends on the first, whose tip then lies within touch of the second
  const Vec2 tip(5, 4);
  const CrackRegistry registry =
      resolved({{{2, 4}, tip}, {{8, 4.0005}, {5.1, 4.0003}, tip + Vec2(-0.004, 0)}});
  EXPECT_EQ(registry.active_tips(), 2) << "the two far ends";
  EXPECT_EQ(registry.cracks()[0].points.back(), registry.cracks()[1].points.back());
}

TEST(CrackRegistryTest, AnEndMovedAwayIsFollowedByThoseThatHadJoinedIt) {
  // the first joins the second's end, which then moves onto the third's face
  const double off = 0.8 * tolerance;
  const CrackRegistry registry =
      resolved({{{2, 6}, {5, 4 + 2 * off}}, {{8, 6}, {5, 4 + off}}, {{2, 4}, {8, 4}}});
  EXPECT_EQ(registry.cracks()[0].points.back(), registry.cracks()[1].points.back());
  EXPECT_NEAR(registry.cracks()[0].points.back().y(), 4, 1e-15);
  EXPECT_EQ(registry.active_tips(), 4);
}

TEST(CrackRegistryTest, TheRimComesBeforeOtherCracks) {
  const CrackRegistry registry = resolved({{{0, 4}, {3, 4}}, {{0, 4}, {3, 6}}});
  EXPECT_EQ(end_of(registry, 0, 0).state, TipState::boundary);
  EXPECT_EQ(end_of(registry, 1, 0).state, TipState::boundary);
  EXPECT_EQ(registry.active_tips(), 2);
}

TEST(CrackRegistryTest, AddsUpLengths) {
  const CrackRegistry registry = resolved({{{1, 1}, {4, 5}, {4, 7}}, {{6, 2}, {6, 3}}});
  EXPECT_DOUBLE_EQ(registry.cracks()[0].length(), 7.0);
  EXPECT_DOUBLE_EQ(registry.length(), 8.0);
}

TEST(CrackRegistryTest, GrowsAtEitherEnd) {
  CrackRegistry registry = resolved({{{2, 2}, {4, 3}}, {{6, 2}, {6, 6}}});
  registry.advance(0, 1, Vec2(5, 3), TipState::active, -1, {2, 0});
  registry.advance(0, 0, Vec2(1, 1), TipState::active, -1, {3, 1});
  const Crack& crack = registry.cracks()[0];
  EXPECT_EQ(crack.points, (std::vector<Vec2>{{1, 1}, {2, 2}, {4, 3}, {5, 3}}));
  EXPECT_EQ(crack.born, (std::vector<GrowthTime>{{3, 1}, {0, 0}, {2, 0}}));
  EXPECT_EQ(registry.active_tips(), 4);
  EXPECT_TRUE(registry.events().empty());
}

TEST(CrackRegistryTest, GrowthThatMeetsSomethingEndsTheTipWithAnEvent) {
  CrackRegistry registry = resolved({{{2, 2}, {4, 3}}, {{6, 2}, {6, 6}}});
  registry.advance(0, 1, Vec2(6, 3), TipState::coalesced, 1, {4, 2});
  registry.advance(0, 0, Vec2(0, 1), TipState::boundary, -1, {5, 0});
  EXPECT_EQ(registry.active_tips(), 2);
  ASSERT_EQ(registry.events().size(), 2u);
  const Event& event = registry.events()[0];
  EXPECT_EQ(event.kind, EventKind::coalescence);
  EXPECT_EQ(event.crack, 0);
  EXPECT_EQ(event.end, 1);
  EXPECT_EQ(event.partner, 1);
  EXPECT_EQ(event.step, 4);
  EXPECT_EQ(event.cycle, 2);
  EXPECT_EQ(event.at, Vec2(6, 3));
  EXPECT_EQ(registry.events()[1].kind, EventKind::boundary);
}

TEST(CrackRegistryTest, AStepToWhereTheEndIsAddsNoSegment) {
  CrackRegistry registry = resolved({{{2, 2}, {4, 3}}, {{6, 2}, {6, 6}}});
  registry.advance(0, 1, Vec2(4, 3), TipState::coalesced, 1, {4, 2});
  EXPECT_EQ(registry.cracks()[0].points, (std::vector<Vec2>{{2, 2}, {4, 3}}));
  EXPECT_EQ(registry.cracks()[0].born.size(), 1u);
  EXPECT_EQ(end_of(registry, 0, 1).state, TipState::coalesced);
  EXPECT_EQ(registry.events().size(), 1u);
}

TEST(CrackRegistryTest, EndThatWasMetIsATipNoMore) {
  CrackRegistry registry = resolved({{{2, 2}, {4, 3}}, {{6, 2}, {10, 2}}});
  registry.join_end(1, 0, 0, {1, 2});
  EXPECT_EQ(end_of(registry, 1, 0).state, TipState::connected);
  EXPECT_EQ(end_of(registry, 1, 0).partner, 0);
  registry.join_end(1, 1, 0, {1, 2});
  EXPECT_EQ(end_of(registry, 1, 1).state, TipState::boundary) << "had ended before";
}

TEST(CrackRegistryTest, EndsThatGrowthHasJoinedKnowWhereTheTipWas) {
  CrackRegistry registry = resolved({{{2, 2}, {4, 2}}, {{6, 2}, {6, 4}}, {{0, 6}, {3, 6}}});
  EXPECT_EQ(end_of(registry, 0, 1).points_past_tip(), 0);
  EXPECT_FALSE(end_of(registry, 2, 0).points_past_tip()) << "it has never been a tip";
  registry.advance(0, 1, Vec2(5, 2), TipState::active, -1, {1, 0});
  EXPECT_EQ(end_of(registry, 0, 1).points_past_tip(), 0);
  registry.advance(0, 1, Vec2(6, 2), TipState::connected, 1, {2, 0});
  registry.join_end(1, 0, 0, {2, 0});
  EXPECT_EQ(end_of(registry, 0, 1).points_past_tip(), 1);
  EXPECT_EQ(end_of(registry, 1, 0).points_past_tip(), 0);
  EXPECT_EQ(end_of(registry, 0, 1).joined, (GrowthTime{2, 0}));
  EXPECT_EQ(end_of(registry, 1, 0).joined, (GrowthTime{2, 0}));
  EXPECT_EQ(registry.cracks()[0].seen_from(1, 1).front(), Vec2(5, 2));
  // where the end is moved instead, the tip has been there
  registry.advance(2, 1, Vec2(3, 6), TipState::coalesced, 1, {2, 0});
  EXPECT_EQ(end_of(registry, 2, 1).points_past_tip(), 0);
}

TEST(CrackTest, IsSeenFromBothEnds) {
  Crack crack;
  crack.points = {{0, 0}, {2, 0}, {2, 3}};
  EXPECT_EQ(crack.end_point(0), Vec2(0, 0));
  EXPECT_EQ(crack.end_point(1), Vec2(2, 3));
  EXPECT_EQ(crack.end_tangent(0), Vec2(-1, 0));
  EXPECT_EQ(crack.end_tangent(1), Vec2(0, 1));
  EXPECT_EQ(crack.seen_from(0), crack.points);
  EXPECT_EQ(crack.seen_from(1), (std::vector<Vec2>{{2, 3}, {2, 0}, {0, 0}}));
}

TEST(CrackRegistryTest, HashDependsOnNothingElse) {
  const std::vector<std::vector<Vec2>> cracks{{{0, 4}, {3, 4}}, {{2, 6}, {3, 4}}};
  EXPECT_EQ(resolved(cracks).hash(), resolved(cracks).hash());
}

TEST(CrackRegistryTest, HashChangesWithAnyChange) {
  const std::vector<std::vector<Vec2>> base{{{2, 2}, {3, 4}, {5, 5}}, {{6, 6}, {7, 3}}};
  std::vector<std::vector<std::vector<Vec2>>> variants{base};
  for (std::size_t c = 0; c < base.size(); ++c)
    for (std::size_t k = 0; k < base[c].size(); ++k)
      for (int axis = 0; axis < 2; ++axis) {
        variants.push_back(base);
        double& x = variants.back()[c][k][axis];
        x = std::nextafter(x, std::numeric_limits<double>::max());
      }
  variants.push_back({base[1], base[0]});
  variants.push_back({base[0]});
  variants.push_back({{base[0].rbegin(), base[0].rend()}, base[1]});
  variants.push_back({{base[0][0], base[0][1]}, {base[0][2], base[1][0], base[1][1]}});
  variants.push_back({});
  std::set<std::uint64_t> hashes;
  for (const auto& cracks : variants) hashes.insert(resolved(cracks).hash());
  EXPECT_EQ(hashes.size(), variants.size());
}

TEST(CrackRegistryTest, HashSeesGrowthAndWhenItHappened) {
  std::set<std::uint64_t> hashes;
  for (const int step : {1, 2}) {
    CrackRegistry registry = resolved({{{2, 2}, {4, 3}}});
    hashes.insert(registry.hash());
    registry.advance(0, 1, Vec2(5, 3), TipState::active, -1, {step, 0});
    hashes.insert(registry.hash());
  }
  EXPECT_EQ(hashes.size(), 3u);
}

TEST(CrackRegistryTest, HashSeesWhatBecameOfTheEnds) {
  CrackRegistry open, closed;
  for (CrackRegistry* registry : {&open, &closed}) registry->add("c", {{0, 4}, {3, 4}});
  closed.resolve_initial_meetings(body, tolerance);
  EXPECT_EQ(open.cracks()[0].points, closed.cracks()[0].points);
  EXPECT_NE(open.hash(), closed.hash());
}

/// The rim may be wider than what counts as touching; cracks are not.
TEST(CrackRegistryTest, EndsNearTheRimEndOnIt) {
  for (const double gap : {0.05, 0.15}) {
    CrackRegistry registry;
    registry.add("a", {{gap, 4}, {3, 4}});
    registry.add("b", {{3 + gap, 3}, {3 + gap, 5}});
    registry.resolve_initial_meetings(body, tolerance, 0.1);
    EXPECT_EQ(end_of(registry, 0, 0).state, gap < 0.1 ? TipState::boundary : TipState::active);
    EXPECT_EQ(registry.cracks()[0].points.front().x(), gap < 0.1 ? 0.0 : gap);
    EXPECT_EQ(end_of(registry, 0, 1).state, TipState::active);
  }
}

CrackNetwork network(const std::vector<std::vector<Vec2>>& cracks) {
  return network_of(resolved(cracks).cracks(), body, tolerance);
}

TEST(CrackNetworkTest, CountsConnectedGroups) {
  const CrackNetwork none = network({});
  EXPECT_EQ(none.clusters, 0);
  EXPECT_EQ(none.largest, 0.0);
  // an X, a T on it, a loose one
  const CrackNetwork found =
      network({{{2, 2}, {4, 2}}, {{3, 1}, {3, 3}}, {{3, 3}, {4, 3}}, {{7, 2}, {7, 7}}});
  EXPECT_EQ(found.clusters, 2);
  EXPECT_DOUBLE_EQ(found.largest, 5.0);
  EXPECT_FALSE(found.spans_x || found.spans_y);
}

TEST(CrackNetworkTest, AChainOfCracksSpansTheBody) {
  const std::vector<std::vector<Vec2>> chain{{{0, 4}, {4, 5}}, {{4, 5}, {7, 2}}, {{6, 3}, {10, 6}}};
  EXPECT_EQ(network(chain).clusters, 1);
  EXPECT_TRUE(network(chain).spans_x);
  EXPECT_FALSE(network(chain).spans_y);
  const CrackNetwork broken = network({chain[0], chain[2]});
  EXPECT_EQ(broken.clusters, 2);
  EXPECT_FALSE(broken.spans_x) << "two clusters that reach one side each do not span";
  EXPECT_TRUE(network({{{3, 0}, {4, 8}}}).spans_y);
}

}  // namespace
}  // namespace cdca
