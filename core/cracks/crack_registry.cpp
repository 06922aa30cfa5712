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

EventKind event_of(TipState state) {
  if (state == TipState::boundary) return EventKind::boundary;
  return state == TipState::connected ? EventKind::connection : EventKind::coalescence;
}

void CrackRegistry::add(std::string name, std::vector<Vec2> points) {
  Crack crack;
  crack.name = std::move(name);
  crack.points = std::move(points);
  crack.born.assign(crack.segments(), {});
  cracks_.push_back(std::move(crack));
}

void CrackRegistry::advance(int c, int end, const Vec2& to, TipState state, int partner,
                            const GrowthTime& now) {
  Crack& crack = cracks_[std::size_t(c)];
  const bool at_start = end == 0;
  const bool grows = to != crack.end_point(end);
  CrackEnd& there = crack.ends[std::size_t(end)];
  there = {state, partner, -1, {}};
  // in load step 0 initial cracks are put in place, whose ends have not been tips yet
  if (state != TipState::active && now.step > 0) {
    there.tip_was = grows ? 1 : 0;
    there.joined = now;
  }
  if (grows) {
    crack.points.insert(at_start ? crack.points.begin() : crack.points.end(), to);
    crack.born.insert(at_start ? crack.born.begin() : crack.born.end(), now);
  }
  if (state != TipState::active)
    events_.push_back({now.step, now.cycle, event_of(state), c, end, partner, to});
}

void CrackRegistry::place_end(int c, int end, const Vec2& at) {
  const Vec2 from = cracks_[std::size_t(c)].end_point(end);
  for (Crack& crack : cracks_) {
    if (crack.points.front() == from) crack.points.front() = at;
    if (crack.points.back() == from) crack.points.back() = at;
  }
}

void CrackRegistry::join_end(int crack, int end, int partner, const GrowthTime& now) {
  CrackEnd& met = cracks_[std::size_t(crack)].ends[std::size_t(end)];
  if (met.state == TipState::active) met = {TipState::connected, partner, 0, now};
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
    mix(crack.born.data(), crack.born.size() * sizeof(GrowthTime));
    for (const CrackEnd& end : crack.ends) {
      mix(&end.state, sizeof end.state);
      mix(&end.partner, sizeof end.partner);
      mix(&end.tip_was, sizeof end.tip_was);
      mix(&end.joined, sizeof end.joined);
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
        return (foot_on(u, v, x) - x).norm() <= tolerance;
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
