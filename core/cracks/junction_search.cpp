// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/junction_search.hpp"

#include "core/base/errors.hpp"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace cdca {

namespace {

/// How far from the end of a crack a meeting counts as the junction sought, in element sizes: more
/// than cracks that touch lie apart.
constexpr double window = 1e-2;

bool has_joined(const Crack& crack, int end) {
  const CrackEnd& e = crack.ends[std::size_t(end)];
  return e.partner >= 0 && (e.state == TipState::coalesced || e.state == TipState::connected);
}

int segment_at(const Crack& crack, int end) { return end == 0 ? 0 : int(crack.segments()) - 1; }

/// The points of all paths, to be asked which cracks run through a place.
class PathPoints {
 public:
  PathPoints(const CrackPaths& paths, std::size_t cracks)
      : paths_(paths), steps_of_(cracks, {0, 0}) {
    for (std::size_t k = 0; k < paths.steps().size(); ++k) {
      const PathStep& s = paths.steps()[k];
      points_.push_back({s.from.x(), s.from.y(), s.crack, s.segment});
      points_.push_back({s.to.x(), s.to.y(), s.crack, s.segment});
      auto& [first, beyond] = steps_of_[std::size_t(s.crack)];
      if (first == beyond) first = k;
      beyond = k + 1;
    }
    std::sort(points_.begin(), points_.end());
  }

  /// Does a crack run through the place, with a segment other than the given one?
  bool has(const Vec2& at, int crack, int but_segment) const {
    auto it = std::lower_bound(points_.begin(), points_.end(), Point{at.x(), at.y(), crack, -1});
    for (; it != points_.end() && it->x == at.x() && it->y == at.y() && it->crack == crack; ++it) {
      if (it->segment != but_segment) return true;
    }
    return false;
  }

  Reach reach(const std::vector<Crack>& cracks, int c, int end) const {
    const Crack& crack = cracks[std::size_t(c)];
    const int partner = crack.ends[std::size_t(end)].partner, own = segment_at(crack, end);
    const int but = partner == c ? own : -1;
    const auto& steps = paths_.steps();
    const auto [first, beyond] = steps_of_[std::size_t(c)];
    if (first == beyond) return Reach::on;  // nothing of it is left on the grid
    const Vec2 tip = end == 0 ? steps[first].from : steps[beyond - 1].to;
    if (has(tip, partner, but)) return Reach::on;
    // only inside the segment: it may well begin at a junction with the same partner
    for (std::size_t k = 1; first + k < beyond; ++k) {
      const PathStep& s = steps[end == 0 ? first + k : beyond - 1 - k];
      const Vec2 at = end == 0 ? s.from : s.to;
      if (s.segment != own || (at - tip).norm() > window) break;
      if (has(at, partner, but)) return Reach::past;
    }
    return Reach::short_of;
  }

  /// The point of a crack's path that is nearest to a place, grid coordinates.
  Vec2 nearest(const Vec2& at, int crack, int but_segment) const {
    Vec2 best = at;
    double distance = std::numeric_limits<double>::infinity();
    for (const Point& p : points_) {
      const double d = (Vec2(p.x, p.y) - at).norm();
      if (p.crack != crack || p.segment == but_segment || d >= distance) continue;
      best = {p.x, p.y};
      distance = d;
    }
    return best;
  }

 private:
  struct Point {
    double x, y;
    int crack, segment;
    bool operator<(const Point& o) const {
      return std::tie(x, y, crack, segment) < std::tie(o.x, o.y, o.crack, o.segment);
    }
  };

  const CrackPaths& paths_;
  std::vector<Point> points_;
  std::vector<std::pair<std::size_t, std::size_t>> steps_of_;  ///< every crack: first, past last
};

/// One search: places of the end along the line of the crack, judged on the grid.
class JunctionSearch {
 public:
  JunctionSearch(const StructuredGrid& grid, std::vector<Crack> cracks, int crack, int end)
      : grid_(grid), cracks_(std::move(cracks)), crack_(crack), end_(end) {
    const auto path = cracks_[std::size_t(crack)].seen_from(end);
    from_ = grid.to_grid(path[1]);
    start_ = foot();
    along_ = (start_ - from_).normalized();
  }

  Vec2 run() {
    const Reach at_start = reach(0.0);
    if (at_start == Reach::on) return place(0.0);
    // A does not reach, B passes: one of them is the start
    const double sign = at_start == Reach::short_of ? 1.0 : -1.0;
    double a = 0.0, b = 0.0;
    for (double way = CrackPaths::snap;; way *= 2) {
      if (way > window) return nearest_point();
      const Reach r = reach(sign * way);
      if (r == Reach::on) return place(sign * way);
      (r == at_start ? a : b) = sign * way;
      if (r != at_start) break;
    }
    if (at_start == Reach::past) std::swap(a, b);
    for (int k = 0; k < 60; ++k) {
      const double c = 0.5 * (a + b);
      const Reach r = reach(c);
      if (r == Reach::on) return place(c);
      (r == Reach::short_of ? a : b) = c;
    }
    return nearest_point();
  }

 private:
  const CrackEnd& state() const { return cracks_[std::size_t(crack_)].ends[std::size_t(end_)]; }
  int own_segment() const {
    return state().partner == crack_ ? segment_at(cracks_[std::size_t(crack_)], end_) : -1;
  }
  Vec2 place(double t) const { return grid_.from_grid(start_ + t * along_); }

  /// The place of the partner as given that is nearest to the end, grid coordinates.
  Vec2 foot() const {
    const Vec2 x = cracks_[std::size_t(crack_)].end_point(end_);
    const auto& p = cracks_[std::size_t(state().partner)].points;
    Vec2 best = x;
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < p.size(); ++k) {
      if (int(k) == own_segment()) continue;
      const Vec2 foot = foot_on(p[k], p[k + 1], x);
      if ((foot - x).norm() >= distance) continue;
      distance = (foot - x).norm();
      best = foot;
    }
    return grid_.to_grid(best);
  }

  Reach reach(double t) {
    put_end(place(t));
    return reach_of(CrackPaths(grid_, cracks_), cracks_, crack_, end_);
  }

  Vec2 nearest_point() {
    put_end(place(0.0));
    const CrackPaths paths(grid_, cracks_);
    return grid_.from_grid(
        PathPoints(paths, cracks_.size()).nearest(start_, state().partner, own_segment()));
  }

  void put_end(const Vec2& at) {
    Crack& crack = cracks_[std::size_t(crack_)];
    (end_ == 0 ? crack.points.front() : crack.points.back()) = at;
  }

  const StructuredGrid& grid_;
  std::vector<Crack> cracks_;
  int crack_, end_;
  Vec2 from_{0, 0}, start_{0, 0}, along_{0, 0};  ///< grid coordinates
};

}  // namespace

Reach reach_of(const CrackPaths& paths, const std::vector<Crack>& cracks, int crack, int end) {
  return PathPoints(paths, cracks.size()).reach(cracks, crack, end);
}

Vec2 search_junction(const StructuredGrid& grid, const std::vector<Crack>& cracks, int crack,
                     int end) {
  return JunctionSearch(grid, cracks, crack, end).run();
}

CrackPaths lay_paths(const StructuredGrid& grid, CrackRegistry& registry) {
  constexpr int rounds = 8;  // moving one end may unsettle another that is joined to its crack
  for (int round = 0; round < rounds; ++round) {
    CrackPaths paths(grid, registry.cracks());
    const PathPoints points(paths, registry.cracks().size());
    bool moved = false;
    for (std::size_t c = 0; c < registry.cracks().size(); ++c) {
      for (int end = 0; end < 2; ++end) {
        if (!has_joined(registry.cracks()[c], end)) continue;
        if (points.reach(registry.cracks(), int(c), end) == Reach::on) continue;
        registry.place_end(int(c), end, search_junction(grid, registry.cracks(), int(c), end));
        moved = true;
      }
    }
    if (!moved) return paths;
  }
  throw SolveError(
      "a joined crack could not be brought to end on its partner; this is an error "
      "in the program.");
}

}  // namespace cdca
