// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/cut_element.hpp"

#include "core/cells/planar_subdivision.hpp"
#include "core/cells/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cdca {

namespace {

/// Joins polygons into parts.
class Parts {
 public:
  explicit Parts(std::size_t count) : root_(count) { std::iota(root_.begin(), root_.end(), 0); }
  int find(int k) const {
    while (root_[std::size_t(k)] != k) k = root_[std::size_t(k)];
    return k;
  }
  /// The part of `into` keeps its name.
  void join(int polygon, int into) { root_[std::size_t(find(polygon))] = find(into); }

 private:
  std::vector<int> root_;
};

bool is_crack(const SubdivisionEdge& e) { return e.tag >= 0; }

double length_of(const PlanarSubdivision& plane, const SubdivisionEdge& e) {
  return (plane.vertices()[std::size_t(e.b)] - plane.vertices()[std::size_t(e.a)]).norm();
}

/// The polygons that gave up their side of the crack, and the step that bounded them.
struct Absorbed {
  std::vector<int> step;     ///< per polygon; -1: not absorbed
  std::vector<Vec2> beyond;  ///< per absorbed polygon: a place across the crack
};

void join_across_virtual_edges(const PlanarSubdivision& plane, Parts& parts) {
  for (const SubdivisionEdge& e : plane.edges()) {
    if (e.tag == PlanarSubdivision::prolonged && e.left >= 0 && e.right >= 0) {
      const int low = std::min(e.left, e.right), high = std::max(e.left, e.right);
      parts.join(high, low);
    }
  }
}

Absorbed absorb_slivers(const PlanarSubdivision& plane, Parts& parts) {
  const std::size_t count = plane.polygons().size();
  std::vector<double> area(count, 0.0);
  for (std::size_t k = 0; k < count; ++k) area[std::size_t(parts.find(int(k)))] += plane.area(k);
  std::vector<int> order;
  for (std::size_t k = 0; k < count; ++k) {
    if (parts.find(int(k)) == int(k) && area[k] < smallest_polygon) order.push_back(int(k));
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const double x = area[std::size_t(a)], y = area[std::size_t(b)];
    return x != y ? x < y : a < b;
  });
  Absorbed absorbed{std::vector<int>(count, -1), std::vector<Vec2>(count, Vec2(0, 0))};
  for (const int sliver : order) {
    std::vector<double> common(count, 0.0);
    std::vector<int> step(count, -1);
    std::vector<Vec2> beyond(count, Vec2(0, 0));
    for (const SubdivisionEdge& e : plane.edges()) {
      if (!is_crack(e) || e.left < 0 || e.right < 0) continue;
      const int l = parts.find(e.left), r = parts.find(e.right);
      if (l == r || (l != sliver && r != sliver)) continue;
      const auto other = std::size_t(l == sliver ? r : l);
      common[other] += length_of(plane, e);
      step[other] = e.tag;
      const Vec2 a = plane.vertices()[std::size_t(e.a)], b = plane.vertices()[std::size_t(e.b)];
      const Vec2 n = turned_left(b - a).normalized();
      beyond[other] = 0.5 * (a + b) + (l == sliver ? -1e-4 : 1e-4) * n;
    }
    const auto best = std::max_element(common.begin(), common.end());
    if (best == common.end() || *best <= 0.0) continue;
    const auto into = int(best - common.begin());
    for (std::size_t k = 0; k < count; ++k) {
      if (parts.find(int(k)) != sliver) continue;
      absorbed.step[k] = step[std::size_t(into)];
      absorbed.beyond[k] = beyond[std::size_t(into)];
    }
    parts.join(sliver, into);
  }
  return absorbed;
}

void add_sides(CutElement& cut, const PlanarSubdivision& plane, const std::vector<int>& part_of,
               const Absorbed& absorbed, const std::vector<TaggedSegment>& segments) {
  for (const SubdivisionEdge& e : plane.edges()) {
    if (e.tag != PlanarSubdivision::rim) continue;
    const Vec2 a = plane.vertices()[std::size_t(e.a)], b = plane.vertices()[std::size_t(e.b)];
    const bool along_x = a.y() == b.y();
    const std::size_t side = along_x ? (a.y() == 0 ? 0 : 2) : (a.x() == 0 ? 3 : 1);
    const int axis = along_x ? 0 : 1;
    const auto polygon = std::size_t(std::max(e.left, e.right));
    SidePortion portion{std::min(a[axis], b[axis]), std::max(a[axis], b[axis]), part_of[polygon],
                        false, -1};
    const double middle = 0.5 * (portion.t0 + portion.t1);
    for (const TaggedSegment& s : segments) {
      const int across = 1 - axis;
      if (s.from[across] != a[across] || s.to[across] != a[across]) continue;
      if (std::min(s.from[axis], s.to[axis]) < middle &&
          middle < std::max(s.from[axis], s.to[axis])) {
        portion.closed = true;
        portion.step = s.tag;
      }
    }
    if (absorbed.step[polygon] >= 0) {
      portion.closed = portion.sliver = true;
      portion.step = absorbed.step[polygon];
    }
    cut.sides[side].push_back(portion);
  }
  for (auto& side : cut.sides) {
    std::sort(side.begin(), side.end(),
              [](const SidePortion& a, const SidePortion& b) { return a.t0 < b.t0; });
  }
}

}  // namespace

bool contains(const std::vector<Vec2>& loop, const Vec2& p) {
  bool inside = false;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
    const double t = nearest_fraction(a, b, p);
    if ((a + t * (b - a) - p).norm() < 1e-12) return true;
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double x = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    inside = inside != (p.x() < x);
  }
  return inside;
}

int CutElement::part_at(const Vec2& p) const {
  for (const ElementPolygon& polygon : polygons) {
    if (contains(polygon.loop, p)) return polygon.part;
  }
  return polygons.empty() ? 0 : polygons.front().part;
}

Vec2 CutElement::place_in(int part) const {
  const ElementPolygon* largest = nullptr;
  for (const ElementPolygon& polygon : polygons) {
    if (polygon.part == part && (!largest || polygon.area > largest->area)) largest = &polygon;
  }
  Vec2 best(0.5, 0.5);
  double area = 0.0;
  for (const auto& t : triangulate(largest->loop)) {
    const double a = cross(t[1] - t[0], t[2] - t[0]);
    if (a > area) {
      area = a;
      best = (t[0] + t[1] + t[2]) / 3;
    }
  }
  return best;
}

CutElement cut_element(const CrackPaths& paths, GridIndex element) {
  const Vec2 corner(element.i, element.j);
  std::vector<TaggedSegment> segments;
  for (const int id : paths.steps_in(element)) {
    const PathStep& step = paths.steps()[std::size_t(id)];
    segments.push_back({step.from - corner, step.to - corner, int(segments.size())});
  }
  const PlanarSubdivision plane(segments);
  const std::size_t count = plane.polygons().size();
  Parts parts(count);
  join_across_virtual_edges(plane, parts);
  const Absorbed absorbed = absorb_slivers(plane, parts);

  CutElement cut;
  cut.parts = 0;
  std::vector<int> part_of(count, -1), name(count, -1);
  for (std::size_t k = 0; k < count; ++k) {
    int& given = name[std::size_t(parts.find(int(k)))];
    if (given < 0) given = cut.parts++;
    part_of[k] = given;
    cut.polygons.push_back({plane.loop(k), given, plane.area(k), std::nullopt});
    if (absorbed.step[k] >= 0) cut.polygons.back().continues = absorbed.beyond[k];
  }
  add_sides(cut, plane, part_of, absorbed, segments);
  for (const SubdivisionEdge& e : plane.edges()) {
    if (!is_crack(e) || e.left < 0 || e.right < 0) continue;
    const int plus = part_of[std::size_t(e.left)], minus = part_of[std::size_t(e.right)];
    // faces that slivers gave up have moved to the element's sides
    const bool given_up =
        absorbed.step[std::size_t(e.left)] >= 0 || absorbed.step[std::size_t(e.right)] >= 0;
    if (plus == minus && given_up) continue;
    cut.faces.push_back({plane.vertices()[std::size_t(e.a)], plane.vertices()[std::size_t(e.b)],
                         e.tag, plus, minus});
  }
  return cut;
}

std::vector<SideContact> contacts(const std::vector<SidePortion>& first,
                                  const std::vector<SidePortion>& second) {
  constexpr double shortest = 1e-9;
  std::vector<SideContact> found;
  for (const SidePortion& a : first) {
    for (const SidePortion& b : second) {
      const double t0 = std::max(a.t0, b.t0), t1 = std::min(a.t1, b.t1);
      if (t1 - t0 < shortest) continue;
      found.push_back({t0, t1, a.part, b.part, !a.closed && !b.closed,
                       a.step >= 0 ? a.step : b.step, a.step < 0, a.sliver && b.sliver});
    }
  }
  // where slivers on both sides have joined parts that meet openly elsewhere, there is no crack
  for (SideContact& c : found) {
    for (const SideContact& other : found) {
      const bool same = other.first == c.first && other.second == c.second;
      if (c.between_slivers && other.open && !other.between_slivers && same) c.open = true;
    }
  }
  return found;
}

}  // namespace cdca
