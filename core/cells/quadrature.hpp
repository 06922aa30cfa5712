// SPDX-License-Identifier: BSD-3-Clause
/// Quadrature on the parts of elements.
#pragma once

#include "core/cells/element_cuts.hpp"

#include <vector>

namespace cdca {

/// A point inside the element ([0, 1]) and its weight in element areas.
struct QuadraturePoint {
  Vec2 at{0, 0};
  double weight = 0.0;
};

/// Exact for the stiffness of bilinear functions on a part. Weights may be negative where a polygon
/// is not convex.
std::vector<QuadraturePoint> plain_quadrature(const CutElement* cut, int part);

/// A tip as quadrature sees it.
struct SingularPlace {
  Vec2 at{0, 0};                ///< inside-the-element coordinates; may lie outside the element
  std::vector<double> bends{};  ///< distances (m) at which the near-tip functions have a kink
};

/// For parts with near-tip functions: polygons are split into triangles; those with a corner at a
/// tip use points collapsed towards it, in the square root of the distance; the others are halved
/// until they are no larger than their distance from every tip, and small where a crack bends.
/// h: element size, m.
std::vector<QuadraturePoint> tip_quadrature(const CutElement* cut, int part,
                                            const std::vector<SingularPlace>& tips, const Vec2& h);

/// n x n Gauss points on every triangle of a part; for smooth integrands that are no polynomials.
std::vector<QuadraturePoint> smooth_quadrature(const CutElement* cut, int part, int n);

/// Splits a simple counter-clockwise polygon into triangles of its corners; from `apex` (a corner)
/// as a fan where that is possible.
std::vector<std::array<Vec2, 3>> triangulate(std::vector<Vec2> loop, const Vec2* apex = nullptr);

/// Points on a straight line, with weights adding up to 1, graded towards the tips.
std::vector<QuadraturePoint> line_quadrature(const Vec2& from, const Vec2& to,
                                             const std::vector<SingularPlace>& tips);

}  // namespace cdca
