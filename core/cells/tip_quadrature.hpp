// SPDX-License-Identifier: BSD-3-Clause
/// Quadrature of functions that are singular at tips and kinked round them.
#pragma once

#include "core/cells/quadrature.hpp"

#include <vector>

namespace cdca {

/// A tip as quadrature sees it.
struct SingularPlace {
  Vec2 at{0, 0};                ///< inside-the-element coordinates; may lie outside the element
  std::vector<double> bends{};  ///< distances (m) at which the near-tip functions have a kink
};

/// How exact quadrature is near tips.
struct TipOrders {
  /// Points along a ray; 5 are exact for products of near-tip functions of a straight crack and
  /// bilinear ones, more for integrands with further factors.
  int along = 5;
  /// The least number along and across rays where functions of other tips act, too.
  int with_others = 9;
  double digits = 15;  ///< to which the space between rays is integrated
};
/// For intensities, which pass over kinks: beside a bend of the crack two elements behind its tip
/// they miss 1e-4 of K, elsewhere less. The grid misses more.
constexpr TipOrders orders_of_intensities{6, 6, 8};
/// For loads that vary in space.
constexpr TipOrders orders_of_loads{8, 9, 15};

/// For parts with near-tip functions: points on rays from the tip, in the square root of the
/// distance, so that what near-tip functions make of a straight crack is exact along them, and as
/// dense between them as the sides of the part seem to bend when seen from the tip. Where several
/// tips are near, triangles are halved until each has but one, and small where circles on which
/// cracks bend meet. h: element size, m.
std::vector<QuadraturePoint> tip_quadrature(const CutElement* cut, int part,
                                            const std::vector<SingularPlace>& tips, const Vec2& h,
                                            const TipOrders& orders = {});

/// Points on a straight line, with weights adding up to 1, graded towards the tips.
std::vector<QuadraturePoint> line_quadrature(const Vec2& from, const Vec2& to,
                                             const std::vector<SingularPlace>& tips);

}  // namespace cdca
