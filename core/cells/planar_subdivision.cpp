// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/planar_subdivision.hpp"

#include "core/cracks/crack.hpp"
#include "core/cracks/segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cdca {

namespace {

constexpr double same_point = 1e-8;

bool on_rim(const Vec2& p) { return p.x() == 0 || p.x() == 1 || p.y() == 0 || p.y() == 1; }

/// A segment that runs along a side closes that side but splits nothing.
bool along_rim(const Vec2& a, const Vec2& b) {
  return (a.x() == b.x() && (a.x() == 0 || a.x() == 1)) ||
         (a.y() == b.y() && (a.y() == 0 || a.y() == 1));
}

}  // namespace

PlanarSubdivision::PlanarSubdivision(const std::vector<TaggedSegment>& segments)
    : vertices_{{0, 0}, {1, 0}, {1, 1}, {0, 1}} {
  add_segments(segments);
  prolong_loose_ends();
  tie_islands();
  add_rim();
  trace();
}

int PlanarSubdivision::vertex_at(const Vec2& p) {
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if ((vertices_[v] - p).norm() < same_point) return int(v);
  }
  vertices_.push_back(p);
  return int(vertices_.size()) - 1;
}

void PlanarSubdivision::add_segments(const std::vector<TaggedSegment>& segments) {
  for (const TaggedSegment& s : segments) {
    vertex_at(s.from);
    vertex_at(s.to);
  }
  for (std::size_t k = 0; k < segments.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l) {
      const auto &s = segments[k], &t = segments[l];
      const auto hit = crossing_of(s.from, s.to, t.from, t.to);
      if (hit) vertex_at(s.from + hit->on_first * (s.to - s.from));
    }
  }
  for (const TaggedSegment& s : segments) {
    if (along_rim(s.from, s.to)) continue;
    std::vector<std::pair<double, int>> chain;
    const Vec2 d = s.to - s.from;
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      const double t = nearest_fraction(s.from, s.to, vertices_[v]);
      if ((s.from + t * d - vertices_[v]).norm() < same_point) chain.emplace_back(t, int(v));
    }
    std::sort(chain.begin(), chain.end());
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      add_edge(chain[k].second, chain[k + 1].second, s.tag);
    }
  }
}

void PlanarSubdivision::add_edge(int a, int b, int tag) {
  if (a == b) return;
  for (const SubdivisionEdge& e : edges_) {
    if ((e.a == a && e.b == b) || (e.a == b && e.b == a)) return;
  }
  edges_.push_back({a, b, tag});
}

void PlanarSubdivision::split_edge(std::size_t edge, int vertex) {
  const SubdivisionEdge old = edges_[edge];
  edges_[edge].b = vertex;
  edges_.push_back({vertex, old.b, old.tag});
}

void PlanarSubdivision::prolong_loose_ends() {
  std::vector<int> degree(vertices_.size(), 0);
  for (const SubdivisionEdge& e : edges_) ++degree[std::size_t(e.a)], ++degree[std::size_t(e.b)];
  const auto count = degree.size();
  for (std::size_t v = 0; v < count; ++v) {
    if (degree[v] != 1 || on_rim(vertices_[v])) continue;
    for (const SubdivisionEdge& e : edges_) {
      if (e.a != int(v) && e.b != int(v)) continue;
      const int other = e.a == int(v) ? e.b : e.a;
      const Vec2 direction = (vertices_[v] - vertices_[std::size_t(other)]).normalized();
      shoot(int(v), direction);
      break;
    }
  }
}

void PlanarSubdivision::tie_islands() {
  // every group of edges must hang on the rim, or its faces would have holes
  std::vector<int> group(vertices_.size());
  std::iota(group.begin(), group.end(), 0);
  const auto find = [&group](int v) {
    while (group[std::size_t(v)] != v) v = group[std::size_t(v)];
    return v;
  };
  for (const SubdivisionEdge& e : edges_) group[std::size_t(find(e.a))] = find(e.b);
  std::vector<bool> tied(vertices_.size(), false);
  std::vector<int> rightmost(vertices_.size(), -1);
  for (std::size_t v = 0; v < group.size(); ++v) {
    const auto g = std::size_t(find(int(v)));
    tied[g] = tied[g] || on_rim(vertices_[v]);
    if (rightmost[g] < 0 || vertices_[v].x() > vertices_[std::size_t(rightmost[g])].x()) {
      rightmost[g] = int(v);
    }
  }
  for (std::size_t g = 0; g < group.size(); ++g) {
    if (rightmost[g] >= 0 && !tied[g]) shoot(rightmost[g], Vec2(1, 0));
  }
}

void PlanarSubdivision::shoot(int from, const Vec2& direction) {
  const Vec2 start = vertices_[std::size_t(from)];
  double reach = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] > 0) reach = std::min(reach, (1 - start[axis]) / direction[axis]);
    if (direction[axis] < 0) reach = std::min(reach, -start[axis] / direction[axis]);
  }
  Vec2 target = start + reach * direction;
  for (int axis = 0; axis < 2; ++axis) {
    target[axis] = std::clamp(target[axis], 0.0, 1.0);
    if (std::abs(target[axis] - std::round(target[axis])) < 1e-12) {
      target[axis] = std::round(target[axis]);
    }
  }
  std::size_t hit_edge = edges_.size();
  double first = 1.0;
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const SubdivisionEdge& e = edges_[k];
    if (e.a == from || e.b == from) continue;
    // edges are lengthened a little, so that a ray cannot slip through a corner between two
    const Vec2 a = vertices_[std::size_t(e.a)], b = vertices_[std::size_t(e.b)];
    const Vec2 d = same_point * (b - a).normalized();
    const auto hit = crossing_of(start, target, a - d, b + d);
    if (hit && hit->on_first < first && hit->on_first * (target - start).norm() > same_point) {
      first = hit->on_first;
      hit_edge = k;
    }
  }
  // a vertex on the ray may be the tip of a crack that comes the other way
  int met = -1;
  const Vec2 way = target - start;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const double t = (vertices_[v] - start).dot(way) / way.squaredNorm();
    const bool on_ray = (start + t * way - vertices_[v]).norm() < same_point;
    if (int(v) == from || !on_ray || t * way.norm() <= same_point || t > first + 1e-12) continue;
    first = t;
    met = int(v);
  }
  const bool reaches_rim = hit_edge == edges_.size();
  const int vertex = met >= 0 ? met : vertex_at(reaches_rim ? target : Vec2(start + first * way));
  if (vertex == from) return;
  if (met < 0 && !reaches_rim && edges_[hit_edge].a != vertex && edges_[hit_edge].b != vertex) {
    split_edge(hit_edge, vertex);
  }
  add_edge(from, vertex, prolonged);
}

void PlanarSubdivision::add_rim() {
  for (std::size_t side = 0; side < 4; ++side) {
    const Vec2 a = vertices_[side], b = vertices_[(side + 1) % 4];
    std::vector<std::pair<double, int>> chain;
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      const Vec2& p = vertices_[v];
      const bool on_side = (a.x() == b.x()) ? p.x() == a.x() : p.y() == a.y();
      if (on_side) chain.emplace_back((p - a).dot(b - a), int(v));
    }
    std::sort(chain.begin(), chain.end());
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      add_edge(chain[k].second, chain[k + 1].second, rim);
    }
  }
}

void PlanarSubdivision::trace() {
  // half-edge 2k runs a -> b on edge k, 2k+1 runs back
  const auto tail = [this](std::size_t h) { return h % 2 ? edges_[h / 2].b : edges_[h / 2].a; };
  const auto head = [this](std::size_t h) { return h % 2 ? edges_[h / 2].a : edges_[h / 2].b; };
  std::vector<std::vector<std::pair<double, std::size_t>>> round(vertices_.size());
  for (std::size_t h = 0; h < 2 * edges_.size(); ++h) {
    const Vec2 d = vertices_[std::size_t(head(h))] - vertices_[std::size_t(tail(h))];
    round[std::size_t(tail(h))].emplace_back(std::atan2(d.y(), d.x()), h);
  }
  for (auto& out : round) std::sort(out.begin(), out.end());
  std::vector<bool> seen(2 * edges_.size(), false);
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (seen[first]) continue;
    std::vector<int> corners;
    std::vector<std::size_t> walked;
    double twice_area = 0.0;
    for (std::size_t h = first; !seen[h];) {
      seen[h] = true;
      corners.push_back(tail(h));
      walked.push_back(h);
      twice_area += cross(vertices_[std::size_t(tail(h))], vertices_[std::size_t(head(h))]);
      // the next half-edge of the face on the left: clockwise from the way back
      const auto& out = round[std::size_t(head(h))];
      std::size_t back = 0;
      while (out[back].second != (h ^ 1U)) ++back;
      h = out[(back + out.size() - 1) % out.size()].second;
    }
    if (twice_area <= 0.0) continue;
    for (const std::size_t h : walked) {
      (h % 2 ? edges_[h / 2].right : edges_[h / 2].left) = int(polygons_.size());
    }
    polygons_.push_back(std::move(corners));
  }
}

double PlanarSubdivision::area(std::size_t polygon) const {
  double twice = 0.0;
  const auto& p = polygons_[polygon];
  for (std::size_t k = 0; k < p.size(); ++k) {
    twice += cross(vertices_[std::size_t(p[k])], vertices_[std::size_t(p[(k + 1) % p.size()])]);
  }
  return 0.5 * twice;
}

std::vector<Vec2> PlanarSubdivision::loop(std::size_t polygon) const {
  std::vector<Vec2> points;
  for (const int v : polygons_[polygon]) points.push_back(vertices_[std::size_t(v)]);
  return points;
}

}  // namespace cdca
