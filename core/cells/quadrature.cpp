// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/quadrature.hpp"

#include "core/cells/gauss.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

namespace {

using Triangle = std::array<Vec2, 3>;

const std::vector<Vec2> unit_square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

double twice_area(const Triangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }

double longest_side(const Triangle& t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

/// Gauss points of the unit square folded onto the triangle.
void add_folded(const Triangle& t, int n, std::vector<QuadraturePoint>& points) {
  const double area = twice_area(t);
  for (const GaussPoint& u : gauss_points(n)) {
    for (const GaussPoint& v : gauss_points(n)) {
      points.push_back({t[0] + u.x * ((1 - v.x) * (t[1] - t[0]) + v.x * (t[2] - t[0])),
                        u.weight * v.weight * u.x * area});
    }
  }
}

bool whole_square(const CutElement* cut) { return !cut || cut->polygons.size() == 1; }

std::vector<QuadraturePoint> square_points(int n) {
  std::vector<QuadraturePoint> points;
  for (const GaussPoint& u : gauss_points(n)) {
    for (const GaussPoint& v : gauss_points(n)) {
      points.push_back({Vec2(u.x, v.x), u.weight * v.weight});
    }
  }
  return points;
}

bool is_ear(const std::vector<Vec2>& loop, std::size_t k) {
  const std::size_t n = loop.size();
  const Vec2 &a = loop[(k + n - 1) % n], &b = loop[k], &c = loop[(k + 1) % n];
  if (cross(b - a, c - b) <= 0) return false;
  for (const Vec2& p : loop) {
    if (p == a || p == b || p == c) continue;
    if (cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0)
      return false;
  }
  return true;
}

}  // namespace

std::vector<std::vector<Vec2>> loops_of(const CutElement* cut, int part) {
  if (!cut) return {unit_square};
  std::vector<std::vector<Vec2>> loops;
  for (const ElementPolygon& polygon : cut->polygons) {
    if (polygon.part == part) loops.push_back(polygon.loop);
  }
  return loops;
}

std::vector<std::array<Vec2, 3>> triangulate(std::vector<Vec2> loop, const Vec2* apex) {
  std::vector<Triangle> triangles;
  if (apex) {
    std::size_t first = 0;
    while (first < loop.size() && (loop[first] - *apex).norm() >= same_corner) ++first;
    if (first < loop.size()) {
      std::rotate(loop.begin(), loop.begin() + std::ptrdiff_t(first), loop.end());
      bool fan = true;
      for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
        const Triangle t{loop[0], loop[k], loop[k + 1]};
        fan = fan && twice_area(t) >= -1e-14;
        triangles.push_back(t);
      }
      if (fan) return triangles;
      triangles.clear();
    }
  }
  while (loop.size() > 3) {
    // the roundest ear first; straight corners go last and cost nothing
    std::size_t best = loop.size();
    double widest = -1.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (!is_ear(loop, k)) continue;
      const std::size_t n = loop.size();
      const Triangle t{loop[(k + n - 1) % n], loop[k], loop[(k + 1) % n]};
      const double shape = twice_area(t) / (longest_side(t) * longest_side(t));
      if (shape > widest) widest = shape, best = k;
    }
    if (best == loop.size()) break;
    const std::size_t n = loop.size();
    triangles.push_back({loop[(best + n - 1) % n], loop[best], loop[(best + 1) % n]});
    loop.erase(loop.begin() + std::ptrdiff_t(best));
  }
  if (loop.size() == 3) triangles.push_back({loop[0], loop[1], loop[2]});
  return triangles;
}

std::vector<QuadraturePoint> plain_quadrature(const CutElement* cut, int part) {
  if (whole_square(cut)) return square_points(2);
  std::vector<QuadraturePoint> points;
  for (const auto& loop : loops_of(cut, part)) {
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      const Triangle t{loop[0], loop[k], loop[k + 1]};
      const double weight = twice_area(t) / 6;
      for (std::size_t l = 0; l < 3; ++l) points.push_back({0.5 * (t[l] + t[(l + 1) % 3]), weight});
    }
  }
  return points;
}

std::vector<QuadraturePoint> smooth_quadrature(const CutElement* cut, int part, int n) {
  if (whole_square(cut)) return square_points(n);
  std::vector<QuadraturePoint> points;
  for (const auto& loop : loops_of(cut, part)) {
    for (const Triangle& t : triangulate(loop)) {
      if (twice_area(t) > 0) add_folded(t, n, points);
    }
  }
  return points;
}

}  // namespace cdca
