// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/tip_zone.hpp"

#include "core/mechanics/williams.hpp"

#include <gtest/gtest.h>

namespace cdca {
namespace {

/// The zones of cracks in a body of 30 x 30 elements of size one.
std::vector<TipZone> zones_of(const std::vector<std::vector<Vec2>>& cracks, const ZoneRule& rule) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(30, 30), 30, 30);
  CrackRegistry registry;
  for (const auto& points : cracks) registry.add("", points);
  registry.resolve_initial_meetings({Vec2(0, 0), Vec2(30, 30)}, 1e-3);
  const ElementCuts cuts(grid, CrackPaths(grid, registry.cracks()));
  return find_tip_zones(cuts, registry.cracks(), rule);
}

TEST(TipZoneTest, ModesAreTheFieldsOfWilliams) {
  for (const bool plane_strain : {false, true}) {
    const Material material{3.0e10, 0.3, plane_strain};
    const auto zones = zones_of({{{4.0, 9.5}, {9.3, 12.2}}}, {0.0, material.kolosov()});
    const TipZone& zone = zones.at(1);
    Eigen::Matrix2d axes;
    axes << zone.frame.tangent(), turned_left(zone.frame.tangent());
    const auto displacement = [&](int mode, const Vec2& way) {
      const TipPolar polar = zone.frame.polar(zone.frame.tip() + way);
      Vec2 u(0, 0);
      for (std::size_t l = 0; l < 4; ++l)
        u += near_tip_functions(polar).value[l] * zone.modes[l].col(mode - 1);
      const Vec2 exact = axes * williams_field(material, mode, polar.r, polar.theta).displacement;
      return std::pair(u, exact);
    };
    for (const int mode : {1, 2}) {
      // the same up to a factor, which is that of the first place
      const auto [first, exact_first] = displacement(mode, Vec2(0.7, 0.4));
      const double unit = first.norm() / exact_first.norm();
      for (const Vec2& way : {Vec2(0.7, 0.4), Vec2(-0.2, 0.9), Vec2(-0.9, 0.1), Vec2(0.3, -1.4)}) {
        const auto [u, exact] = displacement(mode, way);
        EXPECT_LT((u - unit * exact).norm(), 1e-12 * u.norm());
      }
    }
  }
}

TEST(TipZoneTest, CellsTakeModesWhereThereIsLittleRoom) {
  const std::vector<Vec2> crack{{4.1, 14.6}, {14.4, 14.6}};
  const ZoneRule rule{0.0, 2.0};
  const auto alone = zones_of({crack}, rule);
  EXPECT_EQ(alone.at(1).nodes.size(), 4u);
  EXPECT_TRUE(alone.at(1).with_modes.empty());
  // the other crack cuts some of the cells off
  const auto beside = zones_of({crack, {{17.2, 5.3}, {17.2, 25.1}}}, rule);
  EXPECT_TRUE(beside.at(0).with_modes.empty());
  const TipZone& zone = beside.at(1);
  EXPECT_EQ(zone.nodes.size(), zone.with_modes.size() + 4);
  const StructuredGrid grid(Vec2(0, 0), Vec2(30, 30), 30, 30);
  for (const GlobalId n : zone.with_modes) {
    const Vec2 x = grid.node_position(grid.node_index(n));
    EXPECT_LE((x - Vec2(14.4, 14.6)).norm(), rule.reach_with_little_room);
    EXPECT_LT(x.x(), 17.2);
  }
  EXPECT_TRUE(zone.with_modes.count(grid.node({14, 19})));
  EXPECT_FALSE(zone.with_modes.count(grid.node({14, 20})));
  // the rim counts like another crack
  EXPECT_FALSE(zones_of({{{3.4, 14.6}, {14.4, 14.6}}}, rule).at(0).with_modes.empty());
  // what prolongs the crack behind the tip is no other crack
  EXPECT_TRUE(zones_of({{{4.1, 14.6}, {12.0, 14.6}}, {{12.0, 14.6}, {14.4, 14.6}}}, rule)
                  .back()
                  .with_modes.empty());
}

TEST(TipZoneTest, CellsTakeTheModesOfTheNearestTipsWhereTheyCrowd) {
  std::vector<std::vector<Vec2>> cracks;
  for (int k = 0; k < 2; ++k) cracks.push_back({{4.1, 14.6 + 2 * k}, {14.4, 14.6 + 2 * k}});
  const auto two = zones_of(cracks, {0.0, 2.0});
  for (const TipZone& zone : two) EXPECT_FALSE(zone.with_modes.empty());
  cracks.push_back({{14.4, 16.8}, {14.4, 25.1}});
  const auto three = zones_of(cracks, {0.0, 2.0});
  const StructuredGrid grid(Vec2(0, 0), Vec2(30, 30), 30, 30);
  // the tips of zones 1, 3 and 4 are in reach of both nodes
  const GlobalId above = grid.node({16, 16}), below = grid.node({16, 14});
  EXPECT_TRUE(two.at(1).with_modes.count(above));
  EXPECT_FALSE(three.at(1).with_modes.count(above));
  EXPECT_TRUE(three.at(3).with_modes.count(above));
  EXPECT_TRUE(three.at(4).with_modes.count(above));
  EXPECT_TRUE(three.at(1).with_modes.count(below));
  EXPECT_TRUE(three.at(3).with_modes.count(below));
  EXPECT_FALSE(three.at(4).with_modes.count(below));
  // the other ends are as before
  EXPECT_EQ(three.at(2).with_modes, two.at(2).with_modes);
}

/// A tip that has grown into another crack goes on to serve its cells, on either side of the step.
TEST(TipZoneTest, ATipThatHasJoinedLeavesItsFunctionsBehind) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(30, 30), 30, 30);
  CrackRegistry registry;
  registry.add("", {{4.1, 14.6}, {14.4, 14.6}});
  registry.add("", {{17.2, 5.3}, {17.2, 25.1}});
  const auto zones_now = [&] {
    const ElementCuts cuts(grid, CrackPaths(grid, registry.cracks()));
    return find_tip_zones(cuts, registry.cracks(), {0.0, 2.0});
  };
  const TipZone before = zones_now().at(1);
  registry.advance(0, 1, Vec2(17.2, 13.1), TipState::coalesced, 1, {1, 0});
  const ElementCuts cuts(grid, CrackPaths(grid, registry.cracks()));
  const TipZone after = zones_now().at(1);
  EXPECT_TRUE(before.is_active);
  EXPECT_FALSE(after.is_active);
  EXPECT_EQ(after.nodes, before.nodes);
  EXPECT_EQ(after.with_modes, before.with_modes);
  EXPECT_EQ(after.frame.path(), before.frame.path());
  // the step cuts this element into two
  const GridIndex ahead{15, 14};
  ASSERT_EQ(cuts.parts(ahead), 2);
  EXPECT_TRUE(after.acts_on(grid.element(ahead), 0));
  EXPECT_TRUE(after.acts_on(grid.element(ahead), 1));
}

/// What has joined does not lose cells to cracks that come later.
TEST(TipZoneTest, FunctionsLeftBehindActBeyondLaterCracks) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(30, 30), 30, 30);
  CrackRegistry registry;
  registry.add("", {{4.1, 14.6}, {14.4, 14.6}});
  registry.add("", {{17.2, 5.3}, {17.2, 25.1}});
  registry.add("", {{10.3, 22.2}, {12.9, 17.3}});
  const auto zone_now = [&] {
    const ElementCuts cuts(grid, CrackPaths(grid, registry.cracks()));
    return find_tip_zones(cuts, registry.cracks(), {0.0, 2.0}).at(1);
  };
  registry.advance(0, 1, Vec2(17.2, 13.1), TipState::coalesced, 1, {1, 1});
  const TipZone before = zone_now();
  registry.advance(2, 1, Vec2(17.2, 16.2), TipState::coalesced, 1, {1, 2});
  const ElementCuts cuts(grid, CrackPaths(grid, registry.cracks()));
  const TipZone after = zone_now();
  EXPECT_EQ(after.nodes, before.nodes);
  EXPECT_EQ(after.with_modes, before.with_modes);
  const GridIndex cut{15, 16};
  ASSERT_EQ(cuts.parts(cut), 2);
  EXPECT_TRUE(after.acts_on(grid.element(cut), 0));
  EXPECT_TRUE(after.acts_on(grid.element(cut), 1));
  const GridIndex beyond{18, 14};
  EXPECT_FALSE(after.acts_on(grid.element(beyond), 0)) << "that crack was there before";
}

/// Lest the mirrored problem had another answer.
TEST(TipZoneTest, CellsTakeTheModesOfAllTipsThatAreJustAsNear) {
  const auto star = zones_of(
      {{{4, 15}, {13, 15}}, {{26, 15}, {17, 15}}, {{15, 4}, {15, 13}}, {{15, 26}, {15, 17}}},
      {0.0, 2.0});
  const StructuredGrid grid(Vec2(0, 0), Vec2(30, 30), 30, 30);
  for (const std::size_t inner : {1U, 3U, 5U, 7U})
    EXPECT_TRUE(star.at(inner).nodes.count(grid.node({15, 15})));
}

}  // namespace
}  // namespace cdca
