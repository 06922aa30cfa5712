// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/level_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace cdca {

double LevelSet::distance(const Vec2& x) const {
  const auto& p = crack_->points;
  double best = std::numeric_limits<double>::infinity();
  Vec2 offset{0, 0}, normal{0, 0};
  for (std::size_t k = 0; k + 1 < p.size(); ++k) {
    const Vec2 direction = p[k + 1] - p[k];
    const double t = nearest_fraction(p[k], p[k + 1], x);
    const Vec2 gap = x - (p[k] + t * direction);
    const Vec2 n = turned_left(direction).normalized();
    if (gap.norm() < best * (1 - 1e-12)) {
      best = gap.norm();
      offset = gap;
      normal = n;
    } else if (gap.norm() <= best * (1 + 1e-12)) {
      normal += n;  // nearest to a kink: the side is that of the mean normal
    }
  }
  return offset.dot(normal) < 0 ? -best : best;
}

double LevelSet::beyond_end(const Vec2& x, int end) const {
  return (x - crack_->end_point(end)).dot(crack_->end_tangent(end));
}

CellKind kind_of_element(const StructuredGrid& grid, const LevelSet& level_set, const Crack& crack,
                         GridIndex element) {
  const auto corners = grid.corners(element);
  bool beside = false, at_tip = false;
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec2 x = grid.node_position(corners[a]), y = grid.node_position(corners[(a + 1) % 4]);
    const double dx = level_set.distance(x), dy = level_set.distance(y);
    if ((dx < 0) == (dy < 0)) continue;
    const Vec2 entry = x + dx / (dx - dy) * (y - x);
    bool beyond = false;
    for (int end = 0; end < 2; ++end) {
      if (level_set.beyond_end(entry, end) <= 0) continue;
      if ((entry - crack.end_point(end)).norm() > 2 * grid.element_size().norm()) continue;
      beyond = true;
      at_tip = at_tip || crack.ends[std::size_t(end)].state == TipState::active;
    }
    beside = beside || !beyond;
  }
  const auto holds_tip = [&](int end) {
    return crack.ends[std::size_t(end)].state == TipState::active &&
           grid.element_at(grid.to_grid(crack.end_point(end))) == element;
  };
  if (holds_tip(0) || holds_tip(1)) return CellKind::tip;
  if (beside && at_tip) return CellKind::tip;
  return beside ? CellKind::cut : CellKind::continuous;
}

std::vector<GridIndex> narrow_band(const StructuredGrid& grid, const Crack& crack, int margin) {
  std::set<GlobalId> band;
  for (std::size_t k = 0; k < crack.segments(); ++k) {
    const Vec2 a = grid.to_grid(crack.points[k]), b = grid.to_grid(crack.points[k + 1]);
    const int samples = 1 + int(std::ceil(2 * (b - a).norm()));
    for (int s = 0; s <= samples; ++s) {
      const GridIndex at = grid.element_at(a + double(s) / samples * (b - a));
      for (int dj = -margin; dj <= margin; ++dj) {
        for (int di = -margin; di <= margin; ++di) {
          const GridIndex e{at.i + di, at.j + dj};
          if (grid.has_element(e)) band.insert(grid.element(e));
        }
      }
    }
  }
  std::vector<GridIndex> elements;
  for (const GlobalId id : band) elements.push_back(grid.element_index(id));
  return elements;
}

std::vector<CellWeight> cell_weights(const StructuredGrid& grid, const std::vector<Crack>& cracks,
                                     double tip_radius) {
  std::vector<CellWeight> weights;
  for (const Crack& crack : cracks) {
    const LevelSet level_set(crack);
    std::set<GlobalId> cut, tip;
    for (const GridIndex e : narrow_band(grid, crack, 1)) {
      const CellKind kind = kind_of_element(grid, level_set, crack, e);
      if (kind == CellKind::continuous) continue;
      for (const GridIndex corner : grid.corners(e)) {
        (kind == CellKind::tip ? tip : cut).insert(grid.node(corner));
      }
    }
    for (int end = 0; end < 2 && tip_radius > 0; ++end) {
      if (crack.ends[std::size_t(end)].state != TipState::active) continue;
      const Vec2 x = crack.end_point(end);
      const Vec2 lower = grid.to_grid(x - Vec2(tip_radius, tip_radius));
      const Vec2 upper = grid.to_grid(x + Vec2(tip_radius, tip_radius));
      for (int j = std::max(0, int(lower.y())); j <= std::min(grid.ny(), int(upper.y()) + 1); ++j) {
        for (int i = std::max(0, int(lower.x())); i <= std::min(grid.nx(), int(upper.x()) + 1);
             ++i) {
          if ((grid.node_position({i, j}) - x).norm() <= tip_radius) tip.insert(grid.node({i, j}));
        }
      }
    }
    for (const GlobalId n : cut) weights.push_back({grid.node_index(n), 2});
    for (const GlobalId n : tip) weights.push_back({grid.node_index(n), 8});
  }
  return weights;
}

}  // namespace cdca
