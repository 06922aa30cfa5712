// SPDX-License-Identifier: BSD-3-Clause
/// The structured grid of rectangles that never changes while cracks grow.
#pragma once

#include "core/base/types.hpp"

#include <array>

namespace cdca {

/// Column and row of a node or of an element.
struct GridIndex {
  int i = 0;
  int j = 0;
  bool operator==(const GridIndex&) const = default;
};

/// A rectangle split into nx x ny equal elements. Nodes are numbered row by row from the lower left
/// corner, elements likewise. Nothing of the size of the grid is stored.
///
/// Grid coordinates are (x - origin) / element size: element (i, j) covers [i, i+1] x [j, j+1].
class StructuredGrid {
 public:
  StructuredGrid() = default;
  /// size and origin in m.
  StructuredGrid(const Vec2& origin, const Vec2& size, int nx, int ny)
      : origin_(origin), size_(size), h_(size.x() / nx, size.y() / ny), nx_(nx), ny_(ny) {}

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  const Vec2& origin() const { return origin_; }
  const Vec2& size() const { return size_; }
  /// Width and height of an element, m.
  const Vec2& element_size() const { return h_; }
  double smallest_side() const { return h_.minCoeff(); }

  /// The grid of elements twice as large. Where the number of elements is odd it reaches over the
  /// rim by one element of this grid.
  StructuredGrid coarser() const {
    const int nx = (nx_ + 1) / 2, ny = (ny_ + 1) / 2;
    return {origin_, Vec2(2 * nx * h_.x(), 2 * ny * h_.y()), nx, ny};
  }

  GlobalId node_count() const { return GlobalId(nx_ + 1) * (ny_ + 1); }
  GlobalId element_count() const { return GlobalId(nx_) * ny_; }

  GlobalId node(GridIndex n) const { return GlobalId(n.j) * (nx_ + 1) + n.i; }
  GridIndex node_index(GlobalId id) const { return {int(id % (nx_ + 1)), int(id / (nx_ + 1))}; }
  GlobalId element(GridIndex e) const { return GlobalId(e.j) * nx_ + e.i; }
  GridIndex element_index(GlobalId id) const { return {int(id % nx_), int(id / nx_)}; }
  bool has_element(GridIndex e) const { return e.i >= 0 && e.j >= 0 && e.i < nx_ && e.j < ny_; }

  /// Corners of an element, counter-clockwise from the lower left.
  std::array<GridIndex, 4> corners(GridIndex e) const {
    return {{{e.i, e.j}, {e.i + 1, e.j}, {e.i + 1, e.j + 1}, {e.i, e.j + 1}}};
  }
  /// The elements round a node, counter-clockwise from the lower left; the node is corner
  /// (slot + 2) % 4 of the element in that slot. Elements outside the grid are listed as well.
  std::array<GridIndex, 4> elements_round(GridIndex n) const {
    return {{{n.i - 1, n.j - 1}, {n.i, n.j - 1}, {n.i, n.j}, {n.i - 1, n.j}}};
  }

  Vec2 node_position(GridIndex n) const {
    return origin_ + Vec2(size_.x() * n.i / nx_, size_.y() * n.j / ny_);
  }
  Vec2 to_grid(const Vec2& x) const {
    return {(x.x() - origin_.x()) / size_.x() * nx_, (x.y() - origin_.y()) / size_.y() * ny_};
  }
  Vec2 from_grid(const Vec2& g) const {
    return origin_ + Vec2(size_.x() * (g.x() / nx_), size_.y() * (g.y() / ny_));
  }
  /// The element that holds a point given in grid coordinates; points on the rim belong inside.
  GridIndex element_at(const Vec2& g) const;
  /// The node nearest to a point x (m).
  GridIndex nearest_node(const Vec2& x) const;

 private:
  Vec2 origin_{0, 0};
  Vec2 size_{1, 1};
  Vec2 h_{1, 1};
  int nx_ = 1;
  int ny_ = 1;
};

}  // namespace cdca
