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

/// The polygons of a part, counter-clockwise, inside-the-element coordinates; cut: null for an
/// element that no crack touches.
std::vector<std::vector<Vec2>> loops_of(const CutElement* cut, int part);

/// Exact for the stiffness of bilinear functions on a part. Weights may be negative where a polygon
/// is not convex.
std::vector<QuadraturePoint> plain_quadrature(const CutElement* cut, int part);

/// n x n Gauss points on every triangle of a part; for smooth integrands that are no polynomials.
std::vector<QuadraturePoint> smooth_quadrature(const CutElement* cut, int part, int n);

/// A place so near to a corner of a polygon, inside-the-element coordinates, is that corner.
constexpr double same_corner = 1e-7;

/// Splits a simple counter-clockwise polygon into triangles of its corners; from `apex` (a corner)
/// as a fan where that is possible.
std::vector<std::array<Vec2, 3>> triangulate(std::vector<Vec2> loop, const Vec2* apex = nullptr);

}  // namespace cdca
