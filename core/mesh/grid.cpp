// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/grid.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

GridIndex StructuredGrid::element_at(const Vec2& g) const {
  return {std::clamp(int(std::floor(g.x())), 0, nx_ - 1),
          std::clamp(int(std::floor(g.y())), 0, ny_ - 1)};
}

GridIndex StructuredGrid::nearest_node(const Vec2& x) const {
  const Vec2 g = to_grid(x);
  return {std::clamp(int(std::lround(g.x())), 0, nx_), std::clamp(int(std::lround(g.y())), 0, ny_)};
}

}  // namespace cdca
