// SPDX-License-Identifier: BSD-3-Clause
/// Bilinear shape functions of a rectangular element.
#pragma once

#include "core/base/types.hpp"

#include <array>

namespace cdca {

/// Values and derivatives of the four shape functions at one point.
struct ShapeValues {
  std::array<double, 4> value;
  std::array<Vec2, 4> gradient;  ///< per metre
};

/// p: place inside the element, both coordinates in [0, 1]; h: its width and height, m.
inline ShapeValues shape_functions(const Vec2& p, const Vec2& h) {
  const double x = p.x(), y = p.y();
  return {{(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y},
          {Vec2(-(1 - y) / h.x(), -(1 - x) / h.y()), Vec2((1 - y) / h.x(), -x / h.y()),
           Vec2(y / h.x(), x / h.y()), Vec2(-y / h.x(), (1 - x) / h.y())}};
}

}  // namespace cdca
