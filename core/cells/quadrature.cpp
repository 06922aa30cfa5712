// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/quadrature.hpp"

#include "core/cells/gauss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cdca {

namespace {

using Triangle = std::array<Vec2, 3>;

const std::vector<Vec2> unit_square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
constexpr double same_place = 1e-7;

double twice_area(const Triangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }

double longest_side(const Triangle& t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

double distance(const Triangle& t, const Vec2& p) {
  bool inside = true;
  double nearest = 1e300;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 &a = t[k], &b = t[(k + 1) % 3];
    inside = inside && cross(b - a, p - a) >= 0;
    nearest = std::min(nearest, (a + nearest_fraction(a, b, p) * (b - a) - p).norm());
  }
  return inside ? 0.0 : nearest;
}

std::vector<std::vector<Vec2>> loops_of(const CutElement* cut, int part) {
  if (!cut) return {unit_square};
  std::vector<std::vector<Vec2>> loops;
  for (const ElementPolygon& polygon : cut->polygons) {
    if (polygon.part == part) loops.push_back(polygon.loop);
  }
  return loops;
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

/// Parts of the way from the tip (0) to the far side (1) between which the functions are smooth.
std::vector<double> radial_stops(double reach, const std::vector<double>& bends) {
  std::vector<double> stops{0.0};
  for (const double r : bends) {
    const double s = std::sqrt(r / reach);
    if (s > stops.back() + 1e-9 && s < 1.0 - 1e-9) stops.push_back(s);
  }
  stops.push_back(1.0);
  return stops;
}

/// The tip is corner 0; the distance is s^2, so that square roots become polynomials.
void add_collapsed(const Triangle& t, const SingularPlace& tip,
                   std::vector<QuadraturePoint>& points) {
  const Vec2 a = t[1] - t[0], b = t[2] - t[0];
  const double angle = std::abs(std::atan2(cross(a, b), a.dot(b)));
  const bool uneven = std::max(a.norm(), b.norm()) > 3 * std::min(a.norm(), b.norm());
  if (angle > 0.3 * std::numbers::pi ||
      (uneven && (a - b).norm() > 1.5 * std::min(a.norm(), b.norm()))) {
    // halve the angle, not the side: flat triangles would keep one wide half
    const double split = a.norm() / (a.norm() + b.norm());
    const Vec2 middle = t[1] + split * (t[2] - t[1]);
    add_collapsed({t[0], t[1], middle}, tip, points);
    add_collapsed({t[0], middle, t[2]}, tip, points);
    return;
  }
  const double area = twice_area(t);
  for (const GaussPoint& v : gauss_points(12)) {
    const Vec2 ray = (1 - v.x) * a + v.x * b;
    const auto stops = radial_stops(ray.norm(), tip.bends);
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
      const double length = stops[k + 1] - stops[k];
      for (const GaussPoint& g : gauss_points(8)) {
        const double s = stops[k] + g.x * length, r = s * s;
        points.push_back({t[0] + r * ray, 2 * s * r * length * g.weight * v.weight * area});
      }
    }
  }
}

int order_for(double size, double gap) { return gap > 6 * size ? 5 : gap > 3 * size ? 6 : 9; }

double farthest(const Triangle& t, const Vec2& p) {
  return std::max({(t[0] - p).norm(), (t[1] - p).norm(), (t[2] - p).norm()});
}

/// Does a circle on which the functions have a kink run through the triangle?
bool bends_in(const Triangle& t, const SingularPlace& tip) {
  const double near = distance(t, tip.at), far = farthest(t, tip.at);
  return std::any_of(tip.bends.begin(), tip.bends.end(),
                     [&](double r) { return near < r && r < far; });
}

/// Adds the angles, seen from the tip along `axis`, at which the side from a to b meets a circle.
void add_crossings(const Vec2& a, const Vec2& b, double radius, const Vec2& axis,
                   std::vector<double>& angles) {
  // |a + s (b - a)| = radius
  const Vec2 d = b - a;
  const double half = a.dot(d) / d.squaredNorm();
  const double root = half * half - (a.squaredNorm() - radius * radius) / d.squaredNorm();
  if (root <= 0) return;
  for (const double s : {-half - std::sqrt(root), -half + std::sqrt(root)}) {
    if (s <= 0 || s >= 1) continue;
    const Vec2 p = a + s * d;
    angles.push_back(std::atan2(cross(axis, p), axis.dot(p)));
  }
}

/// Where a ray from the tip, which lies outside, enters and leaves a triangle given relative to it.
std::pair<double, double> within(const Triangle& t, const Vec2& ray) {
  double in = 1e300, out = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 &a = t[k], &b = t[(k + 1) % 3];
    const double at_a = cross(ray, a), at_b = cross(ray, b);
    if ((at_a > 0) == (at_b > 0)) continue;
    const double r = ray.dot(a + at_a / (at_a - at_b) * (b - a));
    in = std::min(in, r);
    out = std::max(out, r);
  }
  return {in, out};
}

/// Points on rays from a tip outside the triangle, so that no stretch between two points crosses a
/// circle on which the functions have a kink.
void add_polar(const Triangle& triangle, const SingularPlace& tip,
               std::vector<QuadraturePoint>& points) {
  const Triangle t{triangle[0] - tip.at, triangle[1] - tip.at, triangle[2] - tip.at};
  const Vec2 axis = (t[0] + t[1] + t[2]).normalized(), across = turned_left(axis);
  std::vector<double> angles;
  for (std::size_t k = 0; k < 3; ++k) {
    angles.push_back(std::atan2(cross(axis, t[k]), axis.dot(t[k])));
    for (const double r : tip.bends) add_crossings(t[k], t[(k + 1) % 3], r, axis, angles);
  }
  std::sort(angles.begin(), angles.end());
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) {
    const double width = angles[k + 1] - angles[k];
    if (width <= 1e-12) continue;
    for (const GaussPoint& v : gauss_points(8)) {
      const double angle = angles[k] + v.x * width;
      const Vec2 ray = std::cos(angle) * axis + std::sin(angle) * across;
      const auto [in, out] = within(t, ray);
      std::vector<double> stops{in};
      for (const double r : tip.bends) {
        if (r > in && r < out) stops.push_back(r);
      }
      stops.push_back(out);
      for (std::size_t l = 0; l + 1 < stops.size(); ++l) {
        const double length = stops[l + 1] - stops[l];
        for (const GaussPoint& u : gauss_points(6)) {
          const double r = stops[l] + u.x * length;
          points.push_back({tip.at + r * ray, r * length * u.weight * width * v.weight});
        }
      }
    }
  }
}

/// Where circles of several tips cross, triangles are halved to this part of the element.
constexpr double across_bends = 1.0 / 16;

std::pair<std::size_t, const SingularPlace*> tip_at_corner(const Triangle& t,
                                                           const std::vector<SingularPlace>& tips) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (const SingularPlace& tip : tips) {
      if ((t[k] - tip.at).norm() < same_place) return {k, &tip};
    }
  }
  return {0, nullptr};
}

/// Is another tip too near for points that look at this one only?
bool others_near(const Triangle& t, const SingularPlace* tip,
                 const std::vector<SingularPlace>& tips) {
  for (const SingularPlace& other : tips) {
    if (&other != tip && distance(t, other.at) < longest_side(t)) return true;
  }
  return false;
}

void add_graded(const Triangle& t, const std::vector<SingularPlace>& tips, int depth,
                std::vector<QuadraturePoint>& points) {
  if (twice_area(t) <= 1e-16) return;
  if (const auto [corner, tip] = tip_at_corner(t, tips);
      tip && (depth == 0 || !others_near(t, tip, tips))) {
    add_collapsed({t[corner], t[(corner + 1) % 3], t[(corner + 2) % 3]}, *tip, points);
    return;
  }
  const double size = longest_side(t);
  double gap = 1e300;
  const SingularPlace* bent = nullptr;
  bool bent_twice = false;
  for (const SingularPlace& tip : tips) {
    gap = std::min(gap, distance(t, tip.at));
    if (!bends_in(t, tip)) continue;
    bent_twice = bent != nullptr;
    bent = &tip;
  }
  if (depth == 0 || (gap >= size && !(bent_twice && size > across_bends))) {
    if (bent && !bent_twice && gap > 0) {
      add_polar(t, *bent, points);
    } else {
      add_folded(t, order_for(size, gap), points);
    }
    return;
  }
  std::size_t k = 0;
  for (std::size_t l = 1; l < 3; ++l) {
    if ((t[(l + 1) % 3] - t[l]).norm() > (t[(k + 1) % 3] - t[k]).norm()) k = l;
  }
  const Vec2 a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], m = 0.5 * (a + b);
  add_graded({a, m, c}, tips, depth - 1, points);
  add_graded({m, b, c}, tips, depth - 1, points);
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

std::vector<std::array<Vec2, 3>> triangulate(std::vector<Vec2> loop, const Vec2* apex) {
  std::vector<Triangle> triangles;
  if (apex) {
    std::size_t first = 0;
    while (first < loop.size() && (loop[first] - *apex).norm() >= same_place) ++first;
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

std::vector<QuadraturePoint> tip_quadrature(const CutElement* cut, int part,
                                            const std::vector<SingularPlace>& tips, const Vec2& h) {
  // lengths that count near a tip are metres; the larger side of the element is the unit
  const double unit = h.maxCoeff();
  const Vec2 scale = h / unit;
  std::vector<SingularPlace> near;
  double nearest = 1e300;
  bool bent = false;
  for (const SingularPlace& tip : tips) {
    SingularPlace scaled{tip.at.cwiseProduct(scale), {}};
    for (const double r : tip.bends) scaled.bends.push_back(r / unit);
    nearest = std::min(nearest, (scaled.at - 0.5 * scale).norm());
    bent = bent || !scaled.bends.empty();
    near.push_back(std::move(scaled));
  }
  if (whole_square(cut) && !bent && nearest > 2) return square_points(nearest > 5 ? 5 : 8);
  std::vector<QuadraturePoint> points;
  for (auto loop : loops_of(cut, part)) {
    for (Vec2& p : loop) p = p.cwiseProduct(scale);
    const Vec2* apex = nullptr;
    for (const SingularPlace& tip : near) {
      for (const Vec2& p : loop) {
        if ((p - tip.at).norm() < same_place) apex = &tip.at;
      }
    }
    for (const Triangle& t : triangulate(loop, apex)) add_graded(t, near, 40, points);
  }
  for (QuadraturePoint& q : points) {
    q.at = q.at.cwiseQuotient(scale);
    q.weight /= scale.prod();
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

std::vector<QuadraturePoint> line_quadrature(const Vec2& from, const Vec2& to,
                                             const std::vector<SingularPlace>& tips) {
  std::vector<QuadraturePoint> points;
  const double length = (to - from).norm();
  const auto at = [&](double t) -> Vec2 { return from + t * (to - from); };
  const auto add = [&](auto&& self, double a, double b, int depth) -> void {
    double gap = 1e300;
    for (const SingularPlace& tip : tips) {
      const bool at_a = (at(a) - tip.at).norm() < same_place;
      const bool at_b = (at(b) - tip.at).norm() < same_place;
      if (at_a || at_b) {
        for (const GaussPoint& g : gauss_points(12)) {
          const double s = g.x * g.x;
          points.push_back(
              {at(at_a ? a + s * (b - a) : b - s * (b - a)), 2 * g.x * g.weight * (b - a)});
        }
        return;
      }
      const double t = std::clamp((tip.at - from).dot(to - from) / (length * length), a, b);
      gap = std::min(gap, (at(t) - tip.at).norm());
    }
    if (gap >= (b - a) * length || depth == 0) {
      for (const GaussPoint& g : gauss_points(10))
        points.push_back({at(a + g.x * (b - a)), g.weight * (b - a)});
      return;
    }
    self(self, a, 0.5 * (a + b), depth - 1);
    self(self, 0.5 * (a + b), b, depth - 1);
  };
  add(add, 0.0, 1.0, 40);
  return points;
}

}  // namespace cdca
