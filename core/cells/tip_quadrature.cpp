// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/tip_quadrature.hpp"

#include "core/cells/gauss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cdca {

namespace {

using Loop = std::vector<Vec2>;

constexpr double nothing = 1e-10;

double twice_area(const Loop& loop) {
  double sum = 0.0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    sum += cross(loop[k] - loop[0], loop[k + 1] - loop[0]);
  return sum;
}

double size_of(const Loop& loop) {
  double longest = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k)
    longest = std::max(longest, (loop[(k + 1) % loop.size()] - loop[k]).norm());
  return longest;
}

bool is_convex(const Loop& loop) {
  const std::size_t n = loop.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 in = loop[(k + 1) % n] - loop[k], out = loop[(k + 2) % n] - loop[(k + 1) % n];
    if (cross(in, out) < -1e-14) return false;
  }
  return true;
}

/// How far p lies outside; less than 0 inside.
double distance(const Loop& loop, const Vec2& p) {
  double nearest = 1e300;
  bool inside = true;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
    inside = inside && cross(b - a, p - a) >= 0;
    nearest = std::min(nearest, (a + nearest_fraction(a, b, p) * (b - a) - p).norm());
  }
  return inside ? -nearest : nearest;
}

/// A straight side as seen from a tip in the origin.
struct Side {
  Vec2 from, to;
  Vec2 normal;      ///< away from the tip
  double distance;  ///< of its line

  Side(const Vec2& a, const Vec2& b) : from(a), to(b), normal(turned_left((b - a).normalized())) {
    if (normal.dot(a) < 0) normal = -normal;
    distance = normal.dot(a);
  }
  bool passes_tip() const { return distance < nothing; }
  bool meets(const Vec2& ray) const {
    return (cross(ray, from) > 0) != (cross(ray, to) > 0) && normal.dot(ray) > 0;
  }
  /// Distance at which a ray meets it.
  double along(const Vec2& ray) const { return distance / normal.dot(ray); }
  /// The distance along a ray and the angle go smoothly with this, however near the tip is.
  double place_of(const Vec2& ray) const {
    constexpr double glancing = 1e-12;  // rounding may turn a ray along the side away from it
    return std::asinh(cross(normal, ray) / std::max(normal.dot(ray), glancing));
  }
  Vec2 ray_to(double place) const {
    return (normal + std::sinh(place) * turned_left(normal)) / std::cosh(place);
  }
};

/// The same for one part.
struct Orders {
  int along, least_across;
  double digits;
};

/// Rays over a range of Side::place_of, in which lengths of rays have poles at i pi / 2: Gauss
/// points gain the same factor with every one of them.
int points_across(double range, const Orders& orders) {
  const double gained =
      2 * std::log10(std::numbers::pi / range + std::hypot(std::numbers::pi / range, 1.0));
  return std::max(orders.least_across, int(std::ceil(orders.digits / gained)));
}

/// Directions in which rays meet corners, and where circles on which functions have a kink meet
/// sides: between them the ends of a ray go smoothly with its angle.
std::vector<Vec2> directions_to_stop_at(const std::vector<Side>& sides,
                                        const std::vector<double>& bends, const Vec2& axis) {
  std::vector<Vec2> places;
  for (const Side& side : sides) {
    places.push_back(side.from);
    const Vec2 d = side.to - side.from;
    for (const double radius : bends) {
      // |from + s d| = radius
      const double half = side.from.dot(d) / d.squaredNorm();
      const double root =
          half * half - (side.from.squaredNorm() - radius * radius) / d.squaredNorm();
      if (root <= 0) continue;
      for (const double s : {-half - std::sqrt(root), -half + std::sqrt(root)}) {
        if (s > 0 && s < 1) places.push_back(side.from + s * d);
      }
    }
  }
  places.erase(std::remove_if(places.begin(), places.end(),
                              [](const Vec2& p) { return p.norm() < nothing; }),
               places.end());
  const auto angle = [&axis](const Vec2& p) { return std::atan2(cross(axis, p), axis.dot(p)); };
  std::sort(places.begin(), places.end(),
            [&](const Vec2& p, const Vec2& q) { return angle(p) < angle(q); });
  for (Vec2& p : places) p.normalize();
  return places;
}

/// Points along one ray from the tip: r = s^2 makes polynomials of square roots. `share`: angle
/// that the ray stands for.
void add_ray(const SingularPlace& tip, const Vec2& ray, double in, double out, double share,
             const Orders& orders, std::vector<QuadraturePoint>& points) {
  std::vector<double> stops{std::sqrt(in)};
  for (const double r : tip.bends) {
    if (r > in && r < out) stops.push_back(std::sqrt(r));
  }
  stops.push_back(std::sqrt(out));
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    const double length = stops[k + 1] - stops[k];
    for (const GaussPoint& g : gauss_points(orders.along)) {
      const double s = stops[k] + g.x * length;
      points.push_back({tip.at + s * s * ray, 2 * s * s * s * length * g.weight * share});
    }
  }
}

/// Rays between two directions, which begin at a side, or at the tip, and end at another side.
struct Fan {
  const Side* entry;  ///< null: at the tip
  const Side* exit;

  double range(const Side* side, const Vec2& first, const Vec2& last) const {
    return side ? side->place_of(last) - side->place_of(first) : 0.0;
  }
  void add(const SingularPlace& tip, const Vec2& first, const Vec2& last, const Orders& orders,
           std::vector<QuadraturePoint>& points) const {
    const double by_entry = range(entry, first, last), by_exit = range(exit, first, last);
    const Side* base = by_entry > by_exit ? entry : exit;
    const double least = std::min(by_entry, by_exit), most = std::max(by_entry, by_exit);
    const double start = base->place_of(first);
    if (least > 1) {  // rays that suit the one side are too few for the other, each at its own end
      const Vec2 middle = base->ray_to(start + 0.5 * most);
      add(tip, first, middle, orders, points);
      add(tip, middle, last, orders, points);
      return;
    }
    const int pieces = std::max(1, int(std::ceil(most / 1.5)));
    const double width = most / pieces;
    for (int piece = 0; piece < pieces; ++piece) {
      for (const GaussPoint& g : gauss_points(points_across(width + least, orders))) {
        const double place = start + (piece + g.x) * width;
        const Vec2 ray = base->ray_to(place);
        add_ray(tip, ray, entry ? entry->along(ray) : 0.0, exit->along(ray),
                g.weight * width / std::cosh(place), orders, points);
      }
    }
  }
};

/// Points on rays from a tip that is not inside the convex loop.
void add_rays(const Loop& loop, const SingularPlace& tip, const Orders& orders,
              std::vector<QuadraturePoint>& points) {
  std::vector<Side> sides;
  Vec2 axis(0, 0);
  for (std::size_t k = 0; k < loop.size(); ++k) {
    axis += loop[k] - tip.at;
    if (loop[k] != loop[(k + 1) % loop.size()])
      sides.emplace_back(loop[k] - tip.at, loop[(k + 1) % loop.size()] - tip.at);
  }
  axis.normalize();
  const std::vector<Vec2> stops = directions_to_stop_at(sides, tip.bends, axis);
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    const double angle = std::atan2(cross(stops[k], stops[k + 1]), stops[k].dot(stops[k + 1]));
    if (angle < 1e-12) continue;
    const Vec2 middle = (stops[k] + stops[k + 1]).normalized();
    const Side *entry = nullptr, *exit = nullptr;
    for (const Side& side : sides) {
      if (side.passes_tip() || !side.meets(middle)) continue;
      if (!exit || side.along(middle) > exit->along(middle)) exit = &side;
      if (!entry || side.along(middle) < entry->along(middle)) entry = &side;
    }
    if (exit)
      Fan{entry == exit ? nullptr : entry, exit}.add(tip, stops[k], stops[k + 1], orders, points);
  }
}

/// Does a circle on which the functions have a kink run through the loop?
bool bends_in(const Loop& loop, const SingularPlace& tip) {
  const double near = distance(loop, tip.at);
  double far = 0.0;
  for (const Vec2& p : loop) far = std::max(far, (p - tip.at).norm());
  return std::any_of(tip.bends.begin(), tip.bends.end(),
                     [&](double r) { return near < r && r < far; });
}

/// The convex loop in smaller ones.
std::vector<Loop> split(const Loop& loop) {
  std::vector<Loop> smaller;
  if (loop.size() > 3) {
    for (const auto& t : triangulate(loop)) smaller.emplace_back(t.begin(), t.end());
    return smaller;
  }
  std::size_t k = 0;
  for (std::size_t l = 1; l < 3; ++l) {
    if ((loop[(l + 1) % 3] - loop[l]).norm() > (loop[(k + 1) % 3] - loop[k]).norm()) k = l;
  }
  const Vec2 a = loop[k], b = loop[(k + 1) % 3], c = loop[(k + 2) % 3], m = 0.5 * (a + b);
  return {{a, m, c}, {m, b, c}};
}

/// Where circles of several tips cross, triangles are halved to this part of the element.
constexpr double across_bends = 1.0 / 16;

void add_graded(const Loop& loop, const std::vector<SingularPlace>& tips, const Orders& orders,
                int depth, std::vector<QuadraturePoint>& points) {
  if (twice_area(loop) <= 1e-16) return;
  const double size = size_of(loop);
  const SingularPlace *nearest = nullptr, *bent = nullptr;
  double gap = 1e300;
  int near = 0, kinked = 0;
  for (const SingularPlace& tip : tips) {
    const double d = distance(loop, tip.at);
    if (d < size) ++near;
    if (d < gap) gap = d, nearest = &tip;
    if (bends_in(loop, tip)) bent = &tip, ++kinked;
  }
  const bool alone = near <= 1 && (kinked == 0 || (kinked == 1 && (near == 0 || bent == nearest)));
  if (depth > 0 && !alone && (near > 1 || size > across_bends)) {
    for (const Loop& part : split(loop)) add_graded(part, tips, orders, depth - 1, points);
    return;
  }
  const SingularPlace& tip = near == 0 && bent ? *bent : *nearest;
  if (distance(loop, tip.at) > -nothing) return add_rays(loop, tip, orders, points);
  for (std::size_t k = 0; k < loop.size(); ++k)
    add_rays({tip.at, loop[k], loop[(k + 1) % loop.size()]}, tip, orders, points);
}

/// The corner of the loop in which a tip lies.
const Vec2* tip_in_corner(const Loop& loop, const std::vector<SingularPlace>& tips) {
  for (const SingularPlace& tip : tips) {
    for (const Vec2& p : loop) {
      if ((p - tip.at).norm() < same_corner) return &tip.at;
    }
  }
  return nullptr;
}

}  // namespace

std::vector<QuadraturePoint> tip_quadrature(const CutElement* cut, int part,
                                            const std::vector<SingularPlace>& tips, const Vec2& h,
                                            const TipOrders& wanted) {
  if (tips.empty()) return smooth_quadrature(cut, part, wanted.along);
  // lengths that count near a tip are metres; the larger side of the element is the unit
  const double unit = h.maxCoeff();
  const Vec2 scale = h / unit;
  std::vector<SingularPlace> near;
  double nearest = 1e300;
  bool others_too = tips.size() > 1;  // functions of one tip on rays of another
  for (const SingularPlace& tip : tips) {
    SingularPlace scaled{tip.at.cwiseProduct(scale), {}};
    const Vec2 far = scaled.at.cwiseAbs().cwiseMax((scale - scaled.at).cwiseAbs());
    for (const double r : tip.bends) {
      if (r < far.norm() * unit) scaled.bends.push_back(r / unit);
    }
    nearest = std::min(nearest, (scaled.at - 0.5 * scale).norm());
    if (!scaled.bends.empty()) others_too = true;  // angles change along rays
    near.push_back(std::move(scaled));
  }
  const Orders orders{others_too ? std::max(wanted.along, wanted.with_others) : wanted.along,
                      others_too ? wanted.with_others : 4, wanted.digits};
  const bool whole = !cut || cut->polygons.size() == 1;
  const bool bent = std::any_of(near.begin(), near.end(),
                                [](const SingularPlace& tip) { return !tip.bends.empty(); });
  if (whole && !bent && nearest > 2) return smooth_quadrature(cut, part, nearest > 5 ? 5 : 8);
  std::vector<QuadraturePoint> points;
  for (auto loop : loops_of(cut, part)) {
    for (Vec2& p : loop) p = p.cwiseProduct(scale);
    if (is_convex(loop)) {
      add_graded(loop, near, orders, 40, points);
      continue;
    }
    for (const auto& t : triangulate(loop, tip_in_corner(loop, near)))
      add_graded({t.begin(), t.end()}, near, orders, 40, points);
  }
  for (QuadraturePoint& q : points) {
    q.at = q.at.cwiseQuotient(scale);
    q.weight /= scale.prod();
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
      const bool at_a = (at(a) - tip.at).norm() < same_corner;
      const bool at_b = (at(b) - tip.at).norm() < same_corner;
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
