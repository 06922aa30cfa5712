// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/crack_registry.hpp"

#include "core/cracks/segments.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

namespace cdca {

const char* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::boundary: return "boundary";
    case EventKind::connection: return "connection";
    case EventKind::coalescence: return "coalescence";
    case EventKind::crossing: return "crossing";
    case EventKind::fragment: return "fragment";
    case EventKind::unstable: return "unstable";
    case EventKind::separated: return "separated";
  }
  return "?";
}

namespace {

Vec2 nearest_rim_point(const Rectangle& body, const Vec2& x) {
  const double gaps[4] = {x.x() - body.lower.x(), body.upper.x() - x.x(), x.y() - body.lower.y(),
                          body.upper.y() - x.y()};
  Vec2 p = x;
  switch (std::min_element(gaps, gaps + 4) - gaps) {
    case 0: p.x() = body.lower.x(); break;
    case 1: p.x() = body.upper.x(); break;
    case 2: p.y() = body.lower.y(); break;
    default: p.y() = body.upper.y(); break;
  }
  return p;
}

void move_end(Crack& crack, int end, const Vec2& to) {
  (end == 0 ? crack.points.front() : crack.points.back()) = to;
}

bool boxes_apart(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double margin) {
  return (a.cwiseMax(b).array() + margin < c.cwiseMin(d).array()).any() ||
         (c.cwiseMax(d).array() + margin < a.cwiseMin(b).array()).any();
}

}  // namespace

void CrackRegistry::add(std::string name, std::vector<Vec2> points) {
  Crack crack;
  crack.name = std::move(name);
  crack.points = std::move(points);
  crack.age.assign(crack.segments(), 0);
  cracks_.push_back(std::move(crack));
}

void CrackRegistry::resolve_initial_meetings(const Rectangle& body, double tolerance) {
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    for (int end = 0; end < 2; ++end) {
      end_on_rim(c, end, body, tolerance) || end_on_end(c, end, tolerance) ||
          end_on_face(c, end, tolerance);
    }
  }
  find_crossings(tolerance);
}

bool CrackRegistry::end_on_rim(std::size_t c, int end, const Rectangle& body, double tolerance) {
  const Vec2 x = cracks_[c].end_point(end);
  const Vec2 rim = nearest_rim_point(body, x);
  if ((rim - x).norm() > tolerance) return false;
  move_end(cracks_[c], end, rim);
  cracks_[c].ends[std::size_t(end)] = {TipState::boundary, -1};
  events_.push_back({0, 0, EventKind::boundary, int(c), end, -1, rim});
  return true;
}

bool CrackRegistry::end_on_end(std::size_t c, int end, double tolerance) {
  for (std::size_t other = 0; other < cracks_.size(); ++other) {
    for (int far = 0; far < 2; ++far) {
      const Vec2 there = cracks_[other].end_point(far);
      if (other == c || (there - cracks_[c].end_point(end)).norm() > tolerance) continue;
      move_end(cracks_[c], end, there);
      cracks_[c].ends[std::size_t(end)] = {TipState::connected, int(other)};
      events_.push_back({0, 0, EventKind::connection, int(c), end, int(other), there});
      return true;
    }
  }
  return false;
}

bool CrackRegistry::end_on_face(std::size_t c, int end, double tolerance) {
  const Vec2 x = cracks_[c].end_point(end);
  for (std::size_t other = 0; other < cracks_.size(); ++other) {
    if (other == c) continue;
    const auto& p = cracks_[other].points;
    for (std::size_t k = 0; k + 1 < p.size(); ++k) {
      const Vec2 foot = p[k] + nearest_fraction(p[k], p[k + 1], x) * (p[k + 1] - p[k]);
      if ((foot - x).norm() > tolerance) continue;
      move_end(cracks_[c], end, foot);
      cracks_[c].ends[std::size_t(end)] = {TipState::coalesced, int(other)};
      events_.push_back({0, 0, EventKind::coalescence, int(c), end, int(other), foot});
      return true;
    }
  }
  return false;
}

namespace {

/// Do a-b and c-d cross? Points on a line count as left of it, so that a path that crosses at its
/// kink does so once, and one that only touches there twice or never.
bool sides_change(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto left = [](const Vec2& from, const Vec2& to, const Vec2& x) {
    return cross(to - from, x - from) >= 0.0;
  };
  return left(c, d, a) != left(c, d, b) && left(a, b, c) != left(a, b, d);
}

Vec2 crossing_point(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return a + cross(c - a, d - c) / cross(b - a, d - c) * (b - a);
}

bool ends_at(const Crack& crack, const Vec2& x, double tolerance) {
  return (crack.points.front() - x).norm() <= tolerance ||
         (crack.points.back() - x).norm() <= tolerance;
}

}  // namespace

void CrackRegistry::find_crossings(double tolerance) {
  for (std::size_t a = 0; a < cracks_.size(); ++a) {
    for (std::size_t b = a + 1; b < cracks_.size(); ++b) {
      const auto &p = cracks_[a].points, &q = cracks_[b].points;
      for (std::size_t k = 0; k + 1 < p.size(); ++k) {
        for (std::size_t l = 0; l + 1 < q.size(); ++l) {
          if (boxes_apart(p[k], p[k + 1], q[l], q[l + 1], 0.0)) continue;
          if (!sides_change(p[k], p[k + 1], q[l], q[l + 1])) continue;
          const Vec2 at = crossing_point(p[k], p[k + 1], q[l], q[l + 1]);
          // an end that touches a face does not cross it
          if (ends_at(cracks_[a], at, tolerance) || ends_at(cracks_[b], at, tolerance)) continue;
          events_.push_back({0, 0, EventKind::crossing, int(a), -1, int(b), at});
        }
      }
    }
  }
}

void CrackRegistry::advance(int c, int end, const Vec2& to, TipState state, int partner, int step,
                            int cycle) {
  Crack& crack = cracks_[std::size_t(c)];
  const bool at_start = end == 0;
  crack.points.insert(at_start ? crack.points.begin() : crack.points.end(), to);
  crack.age.insert(at_start ? crack.age.begin() : crack.age.end(), step);
  crack.ends[std::size_t(end)] = {state, partner};
  if (state == TipState::active) return;
  const EventKind kind = state == TipState::boundary    ? EventKind::boundary
                         : state == TipState::connected ? EventKind::connection
                                                        : EventKind::coalescence;
  events_.push_back({step, cycle, kind, c, end, partner, to});
}

void CrackRegistry::join_end(int crack, int end, int partner) {
  CrackEnd& met = cracks_[std::size_t(crack)].ends[std::size_t(end)];
  if (met.state == TipState::active) met = {TipState::connected, partner};
}

int CrackRegistry::active_tips() const {
  int count = 0;
  for (const Crack& crack : cracks_) {
    for (const CrackEnd& end : crack.ends) count += end.state == TipState::active;
  }
  return count;
}

double CrackRegistry::length() const {
  double sum = 0.0;
  for (const Crack& crack : cracks_) sum += crack.length();
  return sum;
}

std::uint64_t CrackRegistry::hash() const {
  std::uint64_t h = 1469598103934665603ULL;  // FNV-1a over the bits
  const auto mix = [&h](const void* data, std::size_t bytes) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t k = 0; k < bytes; ++k) h = (h ^ byte[k]) * 1099511628211ULL;
  };
  for (const Crack& crack : cracks_) {
    for (const Vec2& p : crack.points) mix(p.data(), 2 * sizeof(double));
    mix(crack.age.data(), crack.age.size() * sizeof(int));
    for (const CrackEnd& end : crack.ends) {
      mix(&end.state, sizeof end.state);
      mix(&end.partner, sizeof end.partner);
    }
  }
  return h;
}

namespace {

bool cracks_touch(const Crack& a, const Crack& b, double tolerance) {
  for (std::size_t k = 0; k < a.segments(); ++k) {
    for (std::size_t l = 0; l < b.segments(); ++l) {
      const Vec2 &p = a.points[k], &q = a.points[k + 1], &r = b.points[l], &s = b.points[l + 1];
      if (boxes_apart(p, q, r, s, tolerance)) continue;
      if (crossing_of(p, q, r, s)) return true;
      const auto near = [&](const Vec2& u, const Vec2& v, const Vec2& x) {
        return (u + nearest_fraction(u, v, x) * (v - u) - x).norm() <= tolerance;
      };
      if (near(p, q, r) || near(p, q, s) || near(r, s, p) || near(r, s, q)) return true;
    }
  }
  return false;
}

}  // namespace

CrackNetwork network_of(const std::vector<Crack>& cracks, const Rectangle& body, double tolerance) {
  std::vector<std::size_t> root(cracks.size());
  std::iota(root.begin(), root.end(), std::size_t(0));
  const auto find = [&root](std::size_t k) {
    while (root[k] != k) k = root[k] = root[root[k]];
    return k;
  };
  for (std::size_t a = 0; a < cracks.size(); ++a) {
    for (std::size_t b = a + 1; b < cracks.size(); ++b) {
      if (find(a) != find(b) && cracks_touch(cracks[a], cracks[b], tolerance))
        root[find(b)] = find(a);
    }
  }
  struct Cluster {
    double length = 0.0;
    Vec2 lower{1e300, 1e300}, upper{-1e300, -1e300};
  };
  std::map<std::size_t, Cluster> clusters;
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    Cluster& cluster = clusters[find(c)];
    cluster.length += cracks[c].length();
    for (const Vec2& p : cracks[c].points) {
      cluster.lower = cluster.lower.cwiseMin(p);
      cluster.upper = cluster.upper.cwiseMax(p);
    }
  }
  CrackNetwork network;
  network.clusters = int(clusters.size());
  for (const auto& [id, cluster] : clusters) {
    network.largest = std::max(network.largest, cluster.length);
    const auto reaches = [&](int axis) {
      return cluster.lower[axis] <= body.lower[axis] + tolerance &&
             cluster.upper[axis] >= body.upper[axis] - tolerance;
    };
    network.spans_x = network.spans_x || reaches(0);
    network.spans_y = network.spans_y || reaches(1);
  }
  return network;
}

}  // namespace cdca
