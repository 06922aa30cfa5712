// SPDX-License-Identifier: BSD-3-Clause
/// Where the initial cracks touch and cross: part of the registry.
#include "core/cracks/crack_registry.hpp"
#include "core/cracks/segments.hpp"

#include <algorithm>

namespace cdca {

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

bool ends_at(const Crack& crack, const Vec2& x, double touch) {
  return (crack.points.front() - x).norm() <= touch || (crack.points.back() - x).norm() <= touch;
}

}  // namespace

void CrackRegistry::resolve_initial_meetings(const Rectangle& body, double touch) {
  touch_ = touch;
  // moving an end moves the face behind it, which another tip may touch then
  for (int before = -1; before != active_tips();) {
    before = active_tips();
    for (std::size_t c = 0; c < cracks_.size(); ++c) {
      for (int end = 0; end < 2; ++end) {
        if (cracks_[c].ends[std::size_t(end)].state != TipState::active) continue;
        end_on_rim(c, end, body) || end_on_end(c, end) || end_on_face(c, end);
      }
    }
  }
  find_crossings();
}

void CrackRegistry::end_initially(std::size_t c, int end, const Vec2& at, const CrackEnd& becomes) {
  place_end(int(c), end, at);
  cracks_[c].ends[std::size_t(end)] = becomes;
  events_.push_back({0, 0, event_of(becomes.state), int(c), end, becomes.partner, at});
}

bool CrackRegistry::end_on_rim(std::size_t c, int end, const Rectangle& body) {
  const Vec2 x = cracks_[c].end_point(end), rim = nearest_rim_point(body, x);
  if ((rim - x).norm() > touch_) return false;
  end_initially(c, end, rim, {TipState::boundary, -1});
  return true;
}

bool CrackRegistry::end_on_end(std::size_t c, int end) {
  const Vec2 x = cracks_[c].end_point(end);
  for (std::size_t other = 0; other < cracks_.size(); ++other) {
    for (int far = 0; far < 2; ++far) {
      const Vec2 there = cracks_[other].end_point(far);
      if ((other == c && far == end) || (there - x).norm() > touch_) continue;
      end_initially(c, end, there, {TipState::connected, int(other)});
      return true;
    }
  }
  return false;
}

bool CrackRegistry::end_on_face(std::size_t c, int end) {
  const Vec2 x = cracks_[c].end_point(end);
  for (std::size_t other = 0; other < cracks_.size(); ++other) {
    const auto& p = cracks_[other].points;
    const std::size_t at_end = end == 0 ? 0 : p.size() - 2;
    for (std::size_t k = 0; k + 1 < p.size(); ++k) {
      if (other == c && k == at_end) continue;
      const Vec2 foot = foot_on(p[k], p[k + 1], x);
      if ((foot - x).norm() > touch_) continue;
      end_initially(c, end, end_or_place(p[k], p[k + 1], foot, touch_),
                    {TipState::coalesced, int(other)});
      return true;
    }
  }
  return false;
}

void CrackRegistry::find_crossings() {
  for (std::size_t a = 0; a < cracks_.size(); ++a) {
    for (std::size_t b = a; b < cracks_.size(); ++b) {
      const auto &p = cracks_[a].points, &q = cracks_[b].points;
      for (std::size_t k = 0; k + 1 < p.size(); ++k) {
        for (std::size_t l = a == b ? k + 2 : 0; l + 1 < q.size(); ++l) {
          if (boxes_apart(p[k], p[k + 1], q[l], q[l + 1], 0.0)) continue;
          if (!sides_change(p[k], p[k + 1], q[l], q[l + 1])) continue;
          const Vec2 at = crossing_point(p[k], p[k + 1], q[l], q[l + 1]);
          // an end that touches a face does not cross it
          if (ends_at(cracks_[a], at, touch_) || ends_at(cracks_[b], at, touch_)) continue;
          events_.push_back({0, 0, EventKind::crossing, int(a), -1, int(b), at});
        }
      }
    }
  }
}

}  // namespace cdca
