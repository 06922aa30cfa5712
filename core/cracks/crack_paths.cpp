// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/crack_paths.hpp"

#include "core/cracks/segments.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace cdca {

namespace {

double snapped(double v) {
  const double line = std::round(v);
  return std::abs(v - line) < CrackPaths::snap ? line : v;
}

Vec2 snapped(const Vec2& p) { return {snapped(p.x()), snapped(p.y())}; }

/// Gives points nearer than the snap distance one common position.
class PointPool {
 public:
  Vec2 settle(const Vec2& raw) {
    const Vec2 p = snapped(raw);
    const auto key = [](double v) { return std::int64_t(std::floor(v / cell)); };
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto it = points_.find({key(p.x()) + dx, key(p.y()) + dy});
        if (it == points_.end()) continue;
        for (const Vec2& q : it->second) {
          if ((q - p).norm() < CrackPaths::snap) return q;
        }
      }
    }
    points_[{key(p.x()), key(p.y())}].push_back(p);
    return p;
  }

 private:
  static constexpr double cell = 1e-5;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Vec2>> points_;
};

/// One segment of a crack with the points that lie on it.
struct Chain {
  int crack;
  int segment;
  Vec2 a, b;
  std::vector<std::pair<double, Vec2>> inner;  ///< fraction along the segment, point

  void insert(const Vec2& p) {
    if (p == a || p == b) return;
    inner.emplace_back((p - a).dot(b - a) / (b - a).squaredNorm(), p);
  }
  bool continues(const Chain& other) const { return crack == other.crack && a == other.b; }
  bool near(const Vec2& p) const { return (foot_on(a, b, p) - p).norm() < CrackPaths::snap; }
};

void meet(Chain& s, Chain& t, PointPool& pool) {
  bool touch = false;
  for (const Vec2& p : {t.a, t.b}) {
    if (s.near(p)) s.insert(p), touch = true;
  }
  for (const Vec2& p : {s.a, s.b}) {
    if (t.near(p)) t.insert(p), touch = true;
  }
  if (touch) return;
  if (const auto hit = crossing_of(s.a, s.b, t.a, t.b)) {
    const Vec2 p = pool.settle(s.a + hit->on_first * (s.b - s.a));
    s.insert(p);
    t.insert(p);
  }
}

void find_meetings(std::vector<Chain>& chains, PointPool& pool) {
  // sweep along x, so that only chains with overlapping boxes are compared
  std::vector<std::size_t> order(chains.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  const auto left = [&](std::size_t k) { return std::min(chains[k].a.x(), chains[k].b.x()); };
  std::sort(order.begin(), order.end(), [&](std::size_t k, std::size_t l) {
    return left(k) != left(l) ? left(k) < left(l) : k < l;
  });
  constexpr double margin = 2 * CrackPaths::snap;
  for (std::size_t k = 0; k < order.size(); ++k) {
    Chain& s = chains[order[k]];
    const double right = std::max(s.a.x(), s.b.x()) + margin;
    for (std::size_t l = k + 1; l < order.size() && left(order[l]) <= right; ++l) {
      Chain& t = chains[order[l]];
      if (s.continues(t) || t.continues(s)) continue;
      const bool apart = std::max(s.a.y(), s.b.y()) + margin < std::min(t.a.y(), t.b.y()) ||
                         std::max(t.a.y(), t.b.y()) + margin < std::min(s.a.y(), s.b.y());
      if (!apart) meet(s, t, pool);
    }
  }
}

/// The points where the segment a-b crosses grid lines, from a to b, both ends included.
std::vector<Vec2> cut_by_grid(const Vec2& a, const Vec2& b) {
  std::vector<std::pair<double, Vec2>> hits;
  const Vec2 d = b - a;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = std::min(a[axis], b[axis]), high = std::max(a[axis], b[axis]);
    for (double line = std::floor(low) + 1; line < high; line += 1.0) {
      const double t = (line - a[axis]) / d[axis];
      Vec2 p = a + t * d;
      p[axis] = line;
      p[1 - axis] = snapped(p[1 - axis]);
      hits.emplace_back(t, p);
    }
  }
  std::sort(hits.begin(), hits.end(),
            [](const auto& s, const auto& t) { return s.first < t.first; });
  std::vector<Vec2> points{a};
  for (const auto& [t, p] : hits) {
    if (p != points.back()) points.push_back(p);
  }
  if (b != points.back()) points.push_back(b);
  return points;
}

}  // namespace

CrackPaths::CrackPaths(const StructuredGrid& grid, const std::vector<Crack>& cracks) : grid_(grid) {
  PointPool pool;
  std::vector<Chain> chains;
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    std::vector<Vec2> points;
    for (const Vec2& p : cracks[c].points) points.push_back(pool.settle(grid.to_grid(p)));
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      if (points[k] != points[k + 1])
        chains.push_back({int(c), int(k), points[k], points[k + 1], {}});
    }
    for (int end = 0; end < 2; ++end) {
      const CrackEnd& there = cracks[c].ends[std::size_t(end)];
      const auto past = there.points_past_tip();
      if (!past) continue;
      const auto at = end == 0 ? std::size_t(*past) : points.size() - 1 - std::size_t(*past);
      tips_.push_back({int(c), end, points[at], there.state == TipState::active});
    }
  }
  find_meetings(chains, pool);
  for (Chain& chain : chains) {
    std::sort(chain.inner.begin(), chain.inner.end(),
              [](const auto& s, const auto& t) { return s.first < t.first; });
    std::vector<Vec2> points{chain.a};
    for (const auto& [t, p] : chain.inner) {
      if (p != points.back()) points.push_back(p);
    }
    points.push_back(chain.b);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const auto bits = cut_by_grid(points[k], points[k + 1]);
      for (std::size_t l = 0; l + 1 < bits.size(); ++l) {
        add_step({bits[l], bits[l + 1], chain.crack, chain.segment, chain.b - chain.a});
      }
    }
  }
  for (const auto& [id, steps] : by_element_) touched_.push_back(id);
  std::sort(touched_.begin(), touched_.end());
}

void CrackPaths::add_step(PathStep step) {
  const int id = int(steps_.size());
  const auto attach = [&](GridIndex e) {
    if (grid_.has_element(e)) by_element_[grid_.element(e)].push_back(id);
  };
  const Vec2 middle = 0.5 * (step.from + step.to);
  const int i = int(std::floor(middle.x())), j = int(std::floor(middle.y()));
  const bool along_x = step.from.y() == step.to.y() && step.from.y() == std::round(step.from.y());
  const bool along_y = step.from.x() == step.to.x() && step.from.x() == std::round(step.from.x());
  attach({i, j});
  if (along_x) attach({i, j - 1});
  if (along_y) attach({i - 1, j});
  steps_.push_back(step);
}

const std::vector<int>& CrackPaths::steps_in(GridIndex element) const {
  static const std::vector<int> none;
  if (!grid_.has_element(element)) return none;
  const auto it = by_element_.find(grid_.element(element));
  return it == by_element_.end() ? none : it->second;
}

bool CrackPaths::same_steps(const CrackPaths& other, GridIndex element) const {
  const auto &mine = steps_in(element), &theirs = other.steps_in(element);
  return std::equal(mine.begin(), mine.end(), theirs.begin(), theirs.end(), [&](int k, int l) {
    const PathStep &a = steps_[std::size_t(k)], &b = other.steps_[std::size_t(l)];
    return a.from == b.from && a.to == b.to;
  });
}

}  // namespace cdca
