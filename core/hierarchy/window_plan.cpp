// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/window_plan.hpp"

#include "core/base/sort_once.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace cdca {

namespace {

struct Box {
  GridIndex low, high;  ///< both inside
  bool apart_from(const Box& other, int gap) const {
    return high.i + gap < other.low.i || other.high.i + gap < low.i || high.j + gap < other.low.j ||
           other.high.j + gap < low.j;
  }
};

Box box_of(const StructuredGrid& grid, const std::unordered_set<GlobalId>& nodes) {
  Box box{{grid.nx(), grid.ny()}, {0, 0}};
  for (const GlobalId id : nodes) {
    const GridIndex n = grid.node_index(id);
    box.low = {std::min(box.low.i, n.i), std::min(box.low.j, n.j)};
    box.high = {std::max(box.high.i, n.i), std::max(box.high.j, n.j)};
  }
  return box;
}

bool is_wide(const Box& box) {
  return std::max(box.high.i - box.low.i, box.high.j - box.low.j) > 2;
}

/// Nodes of a box, marked one by one.
class MarkedNodes {
 public:
  explicit MarkedNodes(const Box& box)
      : box_(box),
        width_(box.high.i - box.low.i + 1),
        marks_(std::size_t(width_ * (box.high.j - box.low.j + 1)), 0) {}

  /// Marks those within `reach` of a node.
  void add_round(GridIndex n, int reach) {
    const int low = std::max(n.i - reach, box_.low.i), high = std::min(n.i + reach, box_.high.i);
    for (int j = std::max(n.j - reach, box_.low.j); j <= std::min(n.j + reach, box_.high.j); ++j) {
      for (int i = low; i <= high; ++i) marks_[place({i, j})] = 1;
    }
  }
  /// Ascending.
  std::vector<GlobalId> ids(const StructuredGrid& grid) const {
    std::vector<GlobalId> found;
    for (int j = box_.low.j; j <= box_.high.j; ++j) {
      for (int i = box_.low.i; i <= box_.high.i; ++i) {
        if (marks_[place({i, j})]) found.push_back(grid.node({i, j}));
      }
    }
    return found;
  }

 private:
  std::size_t place(GridIndex n) const {
    return std::size_t((n.j - box_.low.j) * width_ + n.i - box_.low.i);
  }
  Box box_;
  int width_;
  std::vector<char> marks_;
};

int rounded_up(int a, int b) { return (a + b - 1) / b; }

/// From one square to the next of its colour in a row: a cell lies between their windows.
int period_of(const WindowShape& shape) {
  return 1 + rounded_up(2 * shape.overlap + 1, shape.tile);
}

/// Windows for the cells near cracks outside wide zones.
void add_tiles(const StructuredGrid& grid, const std::vector<GlobalId>& seeds,
               const WindowShape& shape, WindowPlans& plans) {
  std::map<std::pair<int, int>, std::vector<GridIndex>> tiles;  // (row, column)
  for (const GlobalId id : seeds) {
    const GridIndex n = grid.node_index(id);
    tiles[{n.j / shape.tile, n.i / shape.tile}].push_back(n);
  }
  const int period = period_of(shape);
  const int around = rounded_up(shape.overlap + shape.reach, shape.tile);
  for (const auto& [tile, own] : tiles) {
    const auto [tj, ti] = tile;
    const Box box{{std::max(0, ti * shape.tile - shape.overlap),
                   std::max(0, tj * shape.tile - shape.overlap)},
                  {std::min(grid.nx(), (ti + 1) * shape.tile - 1 + shape.overlap),
                   std::min(grid.ny(), (tj + 1) * shape.tile - 1 + shape.overlap)}};
    WindowPlan window;
    window.colour = period * (tj % period) + ti % period;
    MarkedNodes marked(box);
    for (int nj = tj - around; nj <= tj + around; ++nj) {
      for (int ni = ti - around; ni <= ti + around; ++ni) {
        const auto near = tiles.find({nj, ni});
        if (near == tiles.end()) continue;
        for (const GridIndex n : near->second) marked.add_round(n, shape.reach);
      }
    }
    window.nodes = marked.ids(grid);
    plans.windows.push_back(std::move(window));
  }
}

/// Windows for wide zones, in colours from `first_colour` on; their cells are taken out of the
/// seeds.
void add_zones(const StructuredGrid& grid, const std::vector<TipZone>& zones, int first_colour,
               std::vector<GlobalId>& seeds, WindowPlans& plans) {
  std::vector<std::pair<Box, int>> placed;
  std::set<GlobalId> inside;
  for (const TipZone& zone : zones) {
    const Box box = box_of(grid, zone.nodes);
    if (!is_wide(box)) continue;
    WindowPlan window;
    MarkedNodes marked(
        {{std::max(0, box.low.i - 1), std::max(0, box.low.j - 1)},
         {std::min(grid.nx(), box.high.i + 1), std::min(grid.ny(), box.high.j + 1)}});
    for (const GlobalId id : zone.nodes) marked.add_round(grid.node_index(id), 1);
    window.nodes = marked.ids(grid);
    inside.insert(zone.nodes.begin(), zone.nodes.end());
    window.colour = first_colour;
    const auto clashes = [&](const auto& other) {
      return other.second == window.colour && !other.first.apart_from(box, 3);
    };
    while (std::any_of(placed.begin(), placed.end(), clashes)) ++window.colour;
    placed.emplace_back(box, window.colour);
    plans.windows.push_back(std::move(window));
  }
  seeds.erase(
      std::remove_if(seeds.begin(), seeds.end(), [&](GlobalId id) { return inside.count(id) > 0; }),
      seeds.end());
}

}  // namespace

WindowPlans plan_windows(const ElementParts& elements, const std::vector<TipZone>& zones,
                         const WindowShape& shape) {
  const StructuredGrid& grid = elements.grid();
  WindowPlans plans;
  for (const GlobalId id : elements.touched_elements()) {
    for (const GridIndex n : grid.corners(grid.element_index(id)))
      plans.near_cracks.push_back(grid.node(n));
  }
  for (const TipZone& zone : zones)
    plans.near_cracks.insert(plans.near_cracks.end(), zone.nodes.begin(), zone.nodes.end());
  sort_once(plans.near_cracks);
  std::vector<GlobalId> seeds = plans.near_cracks;
  add_zones(grid, zones, period_of(shape) * period_of(shape), seeds, plans);
  add_tiles(grid, seeds, shape, plans);
  for (const WindowPlan& w : plans.windows) plans.colours = std::max(plans.colours, w.colour + 1);
  return plans;
}

}  // namespace cdca
