// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/tip_zone.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

namespace cdca {

namespace {

std::vector<GridIndex> elements_holding(const StructuredGrid& grid, const Vec2& at) {
  std::vector<GridIndex> found;
  const int i = int(std::floor(at.x())), j = int(std::floor(at.y()));
  for (int ej = (at.y() == j ? j - 1 : j); ej <= j; ++ej) {
    for (int ei = (at.x() == i ? i - 1 : i); ei <= i; ++ei) {
      if (grid.has_element({ei, ej})) found.push_back({ei, ej});
    }
  }
  return found;
}

double farthest_of_support(const StructuredGrid& grid, GridIndex node, const Vec2& x) {
  double far = 0.0;
  for (const GridIndex e : grid.elements_round(node)) {
    if (!grid.has_element(e)) continue;
    for (const GridIndex corner : grid.corners(e)) {
      far = std::max(far, (grid.node_position(corner) - x).norm());
    }
  }
  return far;
}

std::vector<GridIndex> zone_nodes(const StructuredGrid& grid, const Vec2& at, const TipFrame& frame,
                                  double tip_radius) {
  std::set<GlobalId> ids;
  for (const GridIndex e : elements_holding(grid, at)) {
    for (const GridIndex corner : grid.corners(e)) ids.insert(grid.node(corner));
  }
  tip_radius *= 1 + 1e-9;  // nodes at just this distance are in, on all sides alike
  const Vec2 reach = tip_radius * grid.element_size().cwiseInverse();
  for (int j = std::max(0, int(at.y() - reach.y()));
       j <= std::min(grid.ny(), int(at.y() + reach.y()) + 1); ++j) {
    for (int i = std::max(0, int(at.x() - reach.x()));
         i <= std::min(grid.nx(), int(at.x() + reach.x()) + 1); ++i) {
      if ((grid.node_position({i, j}) - frame.tip()).norm() <= tip_radius)
        ids.insert(grid.node({i, j}));
    }
  }
  std::vector<GridIndex> nodes;
  for (const GlobalId id : ids) {
    const GridIndex n = grid.node_index(id);
    if (farthest_of_support(grid, n, frame.tip()) <= frame.valid_radius()) nodes.push_back(n);
  }
  return nodes;
}

/// Marks what can be reached from (element, part) over open stretches of sides.
void flood(const ElementCuts& cuts, GridIndex start, int part, TipZone& zone) {
  const StructuredGrid& grid = cuts.grid();
  std::deque<std::pair<GridIndex, int>> open{{start, part}};
  zone.parts.at(grid.element(start))[std::size_t(part)] = true;
  while (!open.empty()) {
    const auto [e, p] = open.front();
    open.pop_front();
    const GridIndex next[4] = {{e.i, e.j - 1}, {e.i + 1, e.j}, {e.i, e.j + 1}, {e.i - 1, e.j}};
    for (std::size_t s = 0; s < 4; ++s) {
      if (!grid.has_element(next[s])) continue;
      const auto there = zone.parts.find(grid.element(next[s]));
      if (there == zone.parts.end()) continue;
      for (const SideContact& c : contacts(cuts.side(e, s), cuts.side(next[s], (s + 2) % 4))) {
        if (!c.open || c.first != p || there->second[std::size_t(c.second)]) continue;
        there->second[std::size_t(c.second)] = true;
        open.emplace_back(next[s], c.second);
      }
    }
  }
}

TipZone make_zone(const ElementCuts& cuts, const Crack& crack, const PathTip& tip,
                  double tip_radius) {
  const StructuredGrid& grid = cuts.grid();
  TipZone zone;
  zone.crack = tip.crack;
  zone.end = tip.end;
  std::vector<Vec2> path = crack.seen_from(tip.end);
  path.front() = grid.from_grid(tip.at);
  const TipState far = crack.ends[std::size_t(1 - tip.end)].state;
  zone.frame = TipFrame(std::move(path), far == TipState::active);

  const auto nodes = zone_nodes(grid, tip.at, zone.frame, tip_radius);
  for (const GridIndex n : nodes) {
    for (const GridIndex e : grid.elements_round(n)) {
      if (grid.has_element(e)) zone.parts.try_emplace(grid.element(e), cuts.parts(e), false);
    }
  }
  // just ahead of the tip is uncracked material, whatever meets behind it
  const Vec2 ahead =
      tip.at + 1e-4 * zone.frame.tangent().cwiseQuotient(grid.element_size()).normalized();
  const GridIndex start = grid.element_at(ahead);
  if (zone.parts.count(grid.element(start))) flood(cuts, start, cuts.part_at(start, ahead), zone);
  for (const GridIndex n : nodes) {
    for (const GridIndex e : grid.elements_round(n)) {
      if (!grid.has_element(e)) continue;
      const auto& acts = zone.parts.at(grid.element(e));
      if (std::find(acts.begin(), acts.end(), true) != acts.end()) zone.nodes.insert(grid.node(n));
    }
  }
  return zone;
}

}  // namespace

std::vector<TipZone> find_tip_zones(const ElementCuts& cuts, const std::vector<Crack>& cracks,
                                    double tip_radius) {
  std::vector<TipZone> zones;
  for (const PathTip& tip : cuts.paths().tips()) {
    zones.push_back(make_zone(cuts, cracks[std::size_t(tip.crack)], tip, tip_radius));
  }
  return zones;
}

}  // namespace cdca
