// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/tip_zone.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
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

/// Of a support, to be reached from the tip by cells that take the fields of the modes.
constexpr double least_share = 0.5 - 1e-9;  // cut in just two halves, it counts on either side

/// Is another crack or the rim nearer to the tip than this, in elements?
bool is_within(double room, const StructuredGrid& grid, const CrackPaths& paths, const PathTip& tip,
               const TipFrame& frame) {
  const double limit = 1e-5 * grid.smallest_side();
  const Vec2 beyond = Vec2(grid.nx(), grid.ny()) - tip.at;
  if (std::min(tip.at.minCoeff(), beyond.minCoeff()) < room) return true;
  const GridIndex lower = grid.element_at(tip.at - Vec2(room, room));
  const GridIndex upper = grid.element_at(tip.at + Vec2(room, room));
  for (int j = lower.j; j <= upper.j; ++j) {
    for (int i = lower.i; i <= upper.i; ++i) {
      for (const int k : paths.steps_in({i, j})) {
        const PathStep& step = paths.steps()[std::size_t(k)];
        if (step.crack == tip.crack) continue;
        if ((foot_on(step.from, step.to, tip.at) - tip.at).norm() >= room) continue;
        if (!frame.is_prolonged_by(grid.from_grid(step.from), grid.from_grid(step.to), limit))
          return true;
      }
    }
  }
  return false;
}

std::set<GlobalId> nodes_at_tip(const StructuredGrid& grid, const Vec2& at) {
  std::set<GlobalId> ids;
  for (const GridIndex e : elements_holding(grid, at)) {
    for (const GridIndex corner : grid.corners(e)) ids.insert(grid.node(corner));
  }
  return ids;
}

/// Adds the nodes whose way from the tip is no longer than `reach`; `length` measures ways in grid
/// coordinates, and `box` holds all that can be so short.
template <typename Length>
void insert_nodes(const StructuredGrid& grid, const Vec2& at, const Vec2& box, double reach,
                  Length&& length, std::set<GlobalId>& ids) {
  reach *= 1 + 1e-9;  // nodes at just this distance are in, on all sides alike
  for (int j = std::max(0, int(at.y() - box.y()));
       j <= std::min(grid.ny(), int(at.y() + box.y()) + 1); ++j) {
    for (int i = std::max(0, int(at.x() - box.x()));
         i <= std::min(grid.nx(), int(at.x() + box.x()) + 1); ++i) {
      if (length(Vec2(Vec2(i, j) - at)) <= reach) ids.insert(grid.node({i, j}));
    }
  }
}

/// Marks what can be reached from (element, part) over open stretches of sides, and across the
/// faces that do not block the way.
template <typename Blocks>
void flood(const ElementCuts& cuts, GridIndex start, int part, const Blocks& blocks,
           TipZone& zone) {
  const StructuredGrid& grid = cuts.grid();
  std::deque<std::pair<GridIndex, int>> open;
  const auto reach = [&](GridIndex e, int p) {
    const auto there = zone.parts.find(grid.element(e));
    if (there == zone.parts.end() || there->second[std::size_t(p)]) return;
    there->second[std::size_t(p)] = true;
    open.emplace_back(e, p);
  };
  reach(start, part);
  while (!open.empty()) {
    const auto [e, p] = open.front();
    open.pop_front();
    for (const CrackFace& face : cuts.faces_at(e)) {
      if (blocks(face)) continue;
      if (face.plus_element == e && face.plus_part == p) reach(face.minus_element, face.minus_part);
      if (face.minus_element == e && face.minus_part == p) reach(face.plus_element, face.plus_part);
    }
    const GridIndex next[4] = {{e.i, e.j - 1}, {e.i + 1, e.j}, {e.i, e.j + 1}, {e.i - 1, e.j}};
    for (std::size_t s = 0; s < 4; ++s) {
      if (!grid.has_element(next[s])) continue;
      if (!zone.parts.count(grid.element(next[s]))) continue;
      for (const SideContact& c : contacts(cuts.side(e, s), cuts.side(next[s], (s + 2) % 4))) {
        if (c.open && c.first == p) reach(next[s], c.second);
      }
    }
  }
}

/// Where to start from the tip: elements and parts of them.
std::vector<std::pair<GridIndex, int>> parts_at_tip(const ElementCuts& cuts, const PathTip& tip,
                                                    const TipFrame& frame) {
  const StructuredGrid& grid = cuts.grid();
  std::vector<std::pair<GridIndex, int>> found;
  if (tip.is_active) {
    // just ahead of the tip is uncracked material, whatever meets behind it
    const Vec2 along = frame.tangent().cwiseQuotient(grid.element_size()).normalized();
    const Vec2 ahead = tip.at + 1e-4 * along;
    const GridIndex start = grid.element_at(ahead);
    found.emplace_back(start, cuts.part_at(start, ahead));
    return found;
  }
  for (const GridIndex e : elements_holding(grid, tip.at)) {
    for (const int part : cuts.parts_at(e, tip.at)) found.emplace_back(e, part);
  }
  return found;
}

/// Beyond the end of the crack that the frame follows the functions go on to jump along a ray. Does
/// it run through a part of the element on which they act? There it would open uncracked material.
bool opens_uncracked(const ElementCuts& cuts, const TipZone& zone, GridIndex element) {
  const StructuredGrid& grid = cuts.grid();
  const auto& path = zone.frame.path();
  const Vec2 end = grid.to_grid(path.back());
  const Vec2 along = end - grid.to_grid(path[path.size() - 2]);
  double from = 0.0, to = std::numeric_limits<double>::infinity();  // of the ray, in the element
  const Vec2 corner(element.i, element.j);
  for (int d = 0; d < 2; ++d) {
    const double low = (corner[d] - end[d]) / along[d], high = (corner[d] + 1 - end[d]) / along[d];
    if (along[d] == 0.0) {
      if (end[d] < corner[d] || end[d] > corner[d] + 1) return false;
      continue;
    }
    from = std::max(from, std::min(low, high));
    to = std::min(to, std::max(low, high));
  }
  if (!(from < to)) return false;
  const auto& acts = zone.parts.at(grid.element(element));
  const auto on_crack = [&](const Vec2& at) {  // one that prolongs this one
    const auto& steps = cuts.paths().steps();
    const auto& here = cuts.paths().steps_in(element);
    return std::any_of(here.begin(), here.end(), [&](int k) {
      const PathStep& s = steps[std::size_t(k)];
      return (foot_on(s.from, s.to, at) - at).norm() < 1e-5;
    });
  };
  constexpr int places = 10;  // cracks in between are rare, and the longest stretch counts
  for (int k = 0; k < places; ++k) {
    const Vec2 at = end + (from + (k + 0.5) / places * (to - from)) * along;
    if (acts[std::size_t(cuts.part_at(element, at))] && !on_crack(at)) return true;
  }
  return false;
}

/// How much of a node's support can be reached from the tip: 0 to 1. None, if the functions would
/// open uncracked material there.
double reached_share(const ElementCuts& cuts, const TipZone& zone, GridIndex node) {
  double reached = 0.0, support = 0.0;
  for (const GridIndex e : cuts.grid().elements_round(node)) {
    if (!cuts.grid().has_element(e)) continue;
    if (opens_uncracked(cuts, zone, e)) return 0.0;
    support += 1.0;
    const auto& acts = zone.parts.at(cuts.grid().element(e));
    const CutElement* cut = cuts.find(e);
    if (!cut) reached += acts[0];
    for (std::size_t p = 0; cut && p < cut->polygons.size(); ++p) {
      if (acts[std::size_t(cut->polygons[p].part)]) reached += cut->polygons[p].area;
    }
  }
  return reached / support;
}

/// The fields of modes I and II near the tip of a crack along `tangent`, as coefficients of the
/// functions of Eq. 5.
std::array<Eigen::Matrix2d, 4> mode_fields(double kolosov, const Vec2& tangent) {
  const double k = kolosov;
  Eigen::Matrix2d turn;
  turn << tangent, turned_left(tangent);
  std::array<Eigen::Matrix2d, 4> fields;
  fields[0] << 0, k + 1, k + 1, 0;
  fields[1] << k - 1, 0, 0, 1 - k;
  fields[2] << 1, 0, 0, 1;
  fields[3] << 0, 1, -1, 0;
  for (Eigen::Matrix2d& f : fields) f = turn * f / (k + 1);
  return fields;
}

/// The zone without the decision which cells with modes keep them.
TipZone make_zone(const ElementCuts& cuts, const std::vector<Crack>& cracks, const PathTip& tip,
                  const ZoneRule& rule) {
  const StructuredGrid& grid = cuts.grid();
  const Crack& crack = cracks[std::size_t(tip.crack)];
  const Vec2& h = grid.element_size();
  TipZone zone;
  zone.crack = tip.crack;
  zone.end = tip.end;
  zone.is_active = tip.is_active;
  const int past = *crack.ends[std::size_t(tip.end)].points_past_tip();
  std::vector<Vec2> path = crack.seen_from(tip.end, past);
  path.front() = grid.from_grid(tip.at);
  const TipState far = crack.ends[std::size_t(1 - tip.end)].state;
  zone.frame = TipFrame(std::move(path), far == TipState::active);
  zone.modes = mode_fields(rule.kolosov, zone.frame.tangent());

  std::set<GlobalId> full = nodes_at_tip(grid, tip.at);
  insert_nodes(
      grid, tip.at, rule.radius * h.cwiseInverse(), rule.radius,
      [&](const Vec2& way) { return way.cwiseProduct(h).norm(); }, full);
  std::set<GlobalId> nodes = full;
  if (is_within(rule.little_room, grid, cuts.paths(), tip, zone.frame)) {
    const double reach = rule.reach_with_little_room;
    insert_nodes(
        grid, tip.at, Vec2(reach, reach), reach, [](const Vec2& way) { return way.norm(); }, nodes);
  }
  std::erase_if(nodes, [&](GlobalId n) {
    return farthest_of_support(grid, grid.node_index(n), zone.frame.tip()) >
           zone.frame.valid_radius();
  });
  for (const GlobalId n : nodes) {
    for (const GridIndex e : grid.elements_round(grid.node_index(n))) {
      if (grid.has_element(e)) zone.parts.try_emplace(grid.element(e), cuts.parts(e), false);
    }
  }
  const GrowthTime joined = crack.ends[std::size_t(tip.end)].joined;
  const auto blocks = [&](const CrackFace& face) {
    const Crack& other = cracks[std::size_t(face.crack)];
    return tip.is_active || other.born[std::size_t(face.segment)] < joined;
  };
  for (const auto& [start, part] : parts_at_tip(cuts, tip, zone.frame))
    flood(cuts, start, part, blocks, zone);
  for (const GlobalId n : nodes) {
    const double share = reached_share(cuts, zone, grid.node_index(n));
    if (full.count(n) && share > 0.0) zone.nodes.insert(n);
    if (!full.count(n) && share >= least_share) zone.with_modes.insert(n);
  }
  return zone;
}

/// Leaves cells the modes of the `most` tips that are nearest to them, and of all just as near;
/// those of tips that have joined do not count, and stay.
void leave_crowded_cells(const StructuredGrid& grid, std::vector<TipZone>& zones, int most) {
  const auto distance = [&grid](const TipZone& zone, GlobalId n) {
    return (grid.node_position(grid.node_index(n)) - zone.frame.tip()).norm();
  };
  std::unordered_map<GlobalId, std::vector<double>> wanted;
  for (const TipZone& zone : zones) {
    if (!zone.is_active) continue;
    for (const GlobalId n : zone.nodes) wanted[n].push_back(distance(zone, n));
    for (const GlobalId n : zone.with_modes) wanted[n].push_back(distance(zone, n));
  }
  for (auto& [n, distances] : wanted) std::sort(distances.begin(), distances.end());
  for (TipZone& zone : zones) {
    std::erase_if(zone.with_modes, [&](GlobalId n) {
      if (!zone.is_active) return false;
      const auto& tips = wanted[n];
      return int(tips.size()) > most &&
             distance(zone, n) > (1 + 1e-9) * tips[std::size_t(most - 1)];
    });
    zone.nodes.insert(zone.with_modes.begin(), zone.with_modes.end());
  }
}

}  // namespace

std::vector<TipZone> find_tip_zones(const ElementCuts& cuts, const std::vector<Crack>& cracks,
                                    const ZoneRule& rule) {
  std::vector<TipZone> zones;
  for (const PathTip& tip : cuts.paths().tips()) {
    zones.push_back(make_zone(cuts, cracks, tip, rule));
  }
  leave_crowded_cells(cuts.grid(), zones, rule.most_tips);
  return zones;
}

}  // namespace cdca
