// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/junction_search.hpp"

#include "core/cells/element_cuts.hpp"
#include "core/cracks/meetings.hpp"
#include "core/cracks/obstacles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace cdca {
namespace {

using Polylines = std::vector<std::vector<Vec2>>;

const StructuredGrid square(Vec2(0, 0), Vec2(8, 6), 8, 6);
const StructuredGrid flat(Vec2(-3, 1), Vec2(4, 9), 8, 6);  // 0.5 x 1.5

CrackRegistry registry_of(const StructuredGrid& grid, const Polylines& cracks) {
  CrackRegistry registry;
  for (const auto& points : cracks) {
    std::vector<Vec2> metres;
    for (const Vec2& p : points) metres.push_back(grid.from_grid(p));
    registry.add("", metres);
  }
  registry.resolve_initial_meetings({grid.origin(), grid.origin() + grid.size()},
                                    1e-3 * grid.smallest_side());
  return registry;
}

/// Regions into which the cracks cut the grid: parts of elements that meet openly.
int regions(const ElementCuts& cuts) {
  const StructuredGrid& grid = cuts.grid();
  std::vector<int> first{0};
  for (GlobalId e = 0; e < grid.element_count(); ++e)
    first.push_back(first.back() + cuts.parts(grid.element_index(e)));
  std::vector<int> root(std::size_t(first.back()));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int k) {
    while (root[std::size_t(k)] != k) k = root[std::size_t(k)];
    return k;
  };
  int count = first.back();
  for (GlobalId id = 0; id < grid.element_count(); ++id) {
    const GridIndex e = grid.element_index(id), right{e.i + 1, e.j}, above{e.i, e.j + 1};
    for (const auto& [other, side] : {std::pair(right, 1U), std::pair(above, 2U)}) {
      if (!grid.has_element(other)) continue;
      for (const SideContact& c : contacts(cuts.side(e, side), cuts.side(other, (side + 2) % 4))) {
        if (!c.open) continue;
        const int a = find(first[std::size_t(id)] + c.first);
        const int b = find(first[std::size_t(grid.element(other))] + c.second);
        if (a != b) root[std::size_t(std::max(a, b))] = std::min(a, b), --count;
      }
    }
  }
  return count;
}

int regions(const StructuredGrid& grid, CrackRegistry& registry) {
  return regions(ElementCuts(grid, lay_paths(grid, registry)));
}

TEST(ReachTest, TellsShortFromPast) {
  const auto reach = [](double y) {
    CrackRegistry registry =
        registry_of(square, {{{1.3, 2.4}, {6.6, 2.4}}, {{3.3, 5.2}, {3.3, 2.4}}});
    registry.place_end(1, 1, Vec2(3.3, y));
    return reach_of(CrackPaths(square, registry.cracks()), registry.cracks(), 1, 1);
  };
  EXPECT_EQ(reach(2.4), Reach::on);
  EXPECT_EQ(reach(2.4 + 0.5e-6), Reach::on) << "the grid sees no difference";
  EXPECT_EQ(reach(2.4 + 2e-6), Reach::short_of);
  EXPECT_EQ(reach(2.4 - 2e-6), Reach::past);
  EXPECT_EQ(reach(2.4 - 5e-3), Reach::past);
  EXPECT_EQ(reach(2.4 + 5e-3), Reach::short_of);
}

TEST(ReachTest, TheStartOfTheSegmentIsNoPassing) {
  // a branch between two faces of one partner: its start does not count for its end
  CrackRegistry registry = registry_of(
      square, {{{2, 1.5}, {6, 1.5}, {6, 1.508}, {2, 1.508}}, {{3.3, 1.5}, {3.3, 1.508}}});
  registry.place_end(1, 1, Vec2(3.3, 1.5079));
  EXPECT_EQ(reach_of(CrackPaths(square, registry.cracks()), registry.cracks(), 1, 1),
            Reach::short_of);
}

TEST(JunctionSearchTest, BringsEndsOntoTheirPartner) {
  for (const double off : {-9e-3, -1e-3, -3e-6, 3e-6, 1e-3, 9e-3}) {
    CrackRegistry registry =
        registry_of(square, {{{1.3, 2.4}, {6.6, 3.1}}, {{3.3, 5.2}, {3.6, 2.4 + 0.7 * 2.3 / 5.3}}});
    ASSERT_EQ(registry.cracks()[1].ends[1].state, TipState::coalesced);
    const Vec2 good = registry.cracks()[1].points.back();
    registry.place_end(1, 1, good + Vec2(0, off));
    const Vec2 found = search_junction(square, registry.cracks(), 1, 1);
    EXPECT_LT((found - good).norm(), std::abs(off)) << off;
    registry.place_end(1, 1, found);
    EXPECT_EQ(reach_of(CrackPaths(square, registry.cracks()), registry.cracks(), 1, 1), Reach::on);
  }
}

TEST(JunctionSearchTest, ANodeMovesTheEndOffItsPartner) {
  // the partner passes the node at 1.27e-6, clear of it; an end near by is moved to the node
  const double a = 0.9e-6;
  const Polylines cracks{{{1, 4 - 2 * a}, {5 - 2 * a, 0}}, {{5.9, 4.9}, {3 - a, 2 - a}}};
  CrackRegistry registry = registry_of(square, cracks);
  ASSERT_EQ(registry.cracks()[1].ends[1].state, TipState::coalesced);
  EXPECT_EQ(reach_of(CrackPaths(square, registry.cracks()), registry.cracks(), 1, 1),
            Reach::short_of)
      << "otherwise there is nothing to search";
  CrackRegistry raw = registry;
  const CrackPaths paths = lay_paths(square, registry);
  EXPECT_EQ(reach_of(paths, registry.cracks(), 1, 1), Reach::on);
  EXPECT_LT((registry.cracks()[1].points.back() - raw.cracks()[1].points.back()).norm(), 2e-6);
}

TEST(JunctionSearchTest, EndsInOnePlaceMoveTogether) {
  CrackRegistry registry = registry_of(
      square, {{{1.3, 2.4}, {6.6, 2.4}}, {{3.3, 5.2}, {3.3, 2.4}}, {{4.4, 5.2}, {3.3, 2.4}}});
  registry.place_end(1, 1, Vec2(3.3, 2.4 + 5e-3));
  ASSERT_EQ(registry.cracks()[1].points.back(), registry.cracks()[2].points.back());
  lay_paths(square, registry);
  EXPECT_EQ(registry.cracks()[1].points.back(), registry.cracks()[2].points.back());
  EXPECT_NEAR(registry.cracks()[1].points.back().y(), 2.4, 1e-6);
}

TEST(JunctionSearchTest, ALassoEndsOnItself) {
  const std::vector<Vec2> lasso{
      {0, 1.2}, {5.3, 1.7}, {5.6, 4.3}, {2.4, 4.1}, {2.6, 1.2 + 0.5 * 2.6 / 5.3}};
  CrackRegistry registry = registry_of(square, {lasso});
  EXPECT_EQ(registry.cracks()[0].ends[1].state, TipState::coalesced);
  EXPECT_EQ(registry.cracks()[0].ends[1].partner, 0);
  EXPECT_EQ(regions(square, registry), 2);
  CrackRegistry loop = registry_of(square, {{{2.3, 2.4}, {5.6, 2.7}, {4.1, 4.6}, {2.3, 2.4}}});
  EXPECT_EQ(loop.active_tips(), 0);
  EXPECT_EQ(regions(square, loop), 2);
}

/// Places that try the grid: on or next to nodes, grid lines, vertices.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double any(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>(0, 1)(random_);
  }
  bool chance(double p) { return any(0, 1) < p; }
  /// Of either sign, 1e-11 to 1e-2.
  double tiny() { return (chance(0.5) ? 1 : -1) * std::pow(10, any(-11, -2)); }
  /// Perhaps moved next to a grid line or onto it.
  double coordinate(double x) {
    if (chance(0.5)) return x;
    return std::round(x) + (chance(0.3) ? 0.0 : tiny());
  }
  Vec2 place(double x, double y) { return {coordinate(x), coordinate(y)}; }

 private:
  std::mt19937 random_;
};

/// A crack from the left rim to the right one with a few kinks.
std::vector<Vec2> partner_across(Draw& draw) {
  std::vector<Vec2> points{{0, draw.any(1.5, 3.5)}};
  for (double x = draw.any(1.2, 2.5); x < 6.8; x += draw.any(0.7, 3))
    points.push_back(draw.place(x, draw.any(1.5, 3.5)));
  points.emplace_back(8, draw.any(1.5, 3.5));
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// A place on the polyline: anywhere, next to a vertex, or where it comes next to a grid line.
Vec2 place_on(const std::vector<Vec2>& line, Draw& draw) {
  for (;;) {
    const auto k = std::size_t(draw.any(0, double(line.size()) - 1));
    const Vec2 &a = line[k], d = line[k + 1] - line[k];
    double t = draw.any(0, 1);
    if (draw.chance(0.3)) t = std::clamp(std::round(t) + draw.tiny(), 0.0, 1.0);
    const int axis = draw.chance(0.5) ? 0 : 1;
    if (draw.chance(0.4) && std::abs(d[axis]) > 1e-3)
      t = (std::round(a[axis] + t * d[axis]) + draw.tiny() - a[axis]) / d[axis];
    if (t < 0 || t > 1) continue;
    const Vec2 at = a + t * d;
    if (at.x() > 1 && at.x() < 7) return at;
  }
}

/// From the upper rim down to a place.
std::vector<Vec2> stem_to(const Vec2& at, Draw& draw) {
  std::vector<Vec2> points{{draw.any(1, 7), 6}};
  if (draw.chance(0.5)) points.push_back(draw.place(draw.any(1, 7), draw.any(4.2, 5.5)));
  points.push_back(at);
  return points;
}

/// The stem must not cross the partner before its end, nor leave a neck of less than 3 % of an
/// element beside a kink of it: cut elements do not resolve that.
bool arrives_freely(const std::vector<Vec2>& stem, const std::vector<Vec2>& line) {
  const Vec2 from = stem[stem.size() - 2], to = stem.back();
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const auto hit = hit_of(from, to, line[k], line[k + 1], 0.0);
    if (hit && hit->distance < (to - from).norm() - 2e-3) return false;
    const bool neck = (foot_on(from, to, line[k]) - line[k]).norm() < 0.03;
    if (neck && (line[k] - to).norm() > 0.02) return false;
  }
  return true;
}

/// Lays the cracks, after which all joined ends must lie on their partners and leave as many
/// regions as given.
void expect_junctions(const StructuredGrid& grid, CrackRegistry& registry, int count) {
  const std::vector<Crack> before = registry.cracks();
  const CrackPaths paths = lay_paths(grid, registry);
  for (std::size_t c = 0; c < before.size(); ++c) {
    for (int end = 0; end < 2; ++end) {
      if (before[c].ends[std::size_t(end)].partner < 0) continue;
      EXPECT_EQ(reach_of(paths, registry.cracks(), int(c), end), Reach::on) << c << " " << end;
      const Vec2 after = registry.cracks()[c].end_point(end);
      EXPECT_LT((after - before[c].end_point(end)).norm(), 2e-2);
    }
  }
  EXPECT_EQ(regions(ElementCuts(grid, paths)), count);
}

/// A stem on a crack across the body makes three regions, wherever it ends: as given, and moved off
/// by as much as rounding or the moving of its partner may do.
TEST(JunctionsOnTheGrid, AreThereWhereverTheyLie) {
  int tried = 0, searched = 0;
  for (unsigned seed = 0; tried < 5000; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const StructuredGrid& grid = seed % 2 ? flat : square;
    const auto line = partner_across(draw);
    auto stem = stem_to(place_on(line, draw), draw);
    if (!arrives_freely(stem, line)) continue;
    ++tried;
    if (draw.chance(0.5)) stem.back() += 0.03 * Vec2(draw.tiny(), draw.tiny());
    CrackRegistry registry = registry_of(grid, {line, stem});
    ASSERT_EQ(registry.cracks()[1].ends[1].state, TipState::coalesced);
    if (draw.chance(0.7)) {
      const Vec2 off(draw.tiny(), draw.tiny());
      registry.place_end(1, 1, registry.cracks()[1].points.back() + off);
    }
    searched += reach_of({grid, registry.cracks()}, registry.cracks(), 1, 1) != Reach::on;
    expect_junctions(grid, registry, 3);
  }
  EXPECT_GT(searched, 1000);
}

/// At the tip of a partner, and shortly before it.
TEST(JunctionsOnTheGrid, AreThereNextToTips) {
  int tried = 0;
  for (unsigned seed = 0; tried < 2000; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const Vec2 mouth(0, draw.any(1.5, 3.5)), tip = draw.place(draw.any(2, 6), draw.any(1.5, 3.5));
    const double back = draw.chance(0.3) ? 0.0 : std::abs(draw.tiny());
    const auto stem = stem_to(tip + back * (mouth - tip).normalized(), draw);
    if (!arrives_freely(stem, {mouth, tip})) continue;
    ++tried;
    CrackRegistry registry = registry_of(square, {{mouth, tip}, stem});
    // side by side, the tip may have ended on the stem instead
    EXPECT_LE(registry.active_tips(), back > 1e-3 ? 1 : 0);
    expect_junctions(square, registry, 2);
  }
}

/// A crack that grows onto its partner by its last segment.
TEST(JunctionsOnTheGrid, AreThereAfterGrowth) {
  int tried = 0;
  for (unsigned seed = 0; tried < 2000; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const auto line = partner_across(draw);
    auto stem = stem_to(place_on(line, draw), draw);
    if (!arrives_freely(stem, line)) continue;
    ++tried;
    const Vec2 to = stem.back() + std::abs(draw.tiny()) * (stem.back() - stem[stem.size() - 2]);
    stem.back() =
        stem[stem.size() - 2] + draw.any(0.3, 0.9) * (stem.back() - stem[stem.size() - 2]);
    CrackRegistry registry = registry_of(square, {line, stem});
    if (registry.cracks()[1].ends[1].state != TipState::active) continue;
    const auto incs =
        resolve_meetings(registry, {Vec2(0, 0), Vec2(8, 6)}, 1e-3, {{1, 1, stem.back(), to}});
    const Increment& i = incs.at(0);
    ASSERT_NE(i.state, TipState::active);
    registry.advance(i.crack, i.end, i.to, i.state, i.partner, {1, 0});
    EXPECT_EQ(registry.active_tips(), 0);
    expect_junctions(square, registry, 3);
  }
}

}  // namespace
}  // namespace cdca
