// SPDX-License-Identifier: BSD-3-Clause
/// The weight of the interaction integral.
#pragma once

#include "core/mesh/grid.hpp"
#include "core/mesh/shape_functions.hpp"

#include <algorithm>
#include <array>

namespace cdca {

/// The weight q of the domain, interpolated between its values at the nodes: inside every element
/// it is as smooth as the field itself, so that few points integrate it.
class DomainWeight {
 public:
  DomainWeight(const StructuredGrid& grid, GridIndex element, const Vec2& tip, double radius)
      : size_(grid.element_size()) {
    const auto corners = grid.corners(element);
    for (std::size_t a = 0; a < 4; ++a) {
      at_corner_[a] = plateau((grid.node_position(corners[a]) - tip).norm() / radius);
    }
  }
  bool nothing() const { return all(0.0); }
  bool flat() const { return all(at_corner_[0]); }
  /// p: inside the element, [0, 1].
  double value(const Vec2& p) const {
    const ShapeValues n = shape_functions(p, size_);
    double q = 0.0;
    for (std::size_t a = 0; a < 4; ++a) q += n.value[a] * at_corner_[a];
    return q;
  }
  /// 1/m, in global axes.
  Vec2 gradient(const Vec2& p) const {
    const ShapeValues n = shape_functions(p, size_);
    Vec2 g(0, 0);
    for (std::size_t a = 0; a < 4; ++a) g += n.gradient[a] * at_corner_[a];
    return g;
  }

 private:
  /// 1 up to half the radius, smoothly down to 0 at the radius.
  static double plateau(double share) {
    const double x = std::clamp(2 * share - 1, 0.0, 1.0);
    return 1 - x * x * x * (10 - 15 * x + 6 * x * x);
  }
  bool all(double q) const {
    return std::all_of(at_corner_.begin(), at_corner_.end(), [q](double at) { return at == q; });
  }

  Vec2 size_;
  std::array<double, 4> at_corner_{};
};

}  // namespace cdca
