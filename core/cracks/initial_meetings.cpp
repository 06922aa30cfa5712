// SPDX-License-Identifier: BSD-3-Clause
/// Where the initial cracks touch and cross.
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

/// The ends of initial cracks, one after the other.
class InitialMeetings {
 public:
  InitialMeetings(CrackRegistry& registry, const Rectangle& body, double touch, double rim)
      : registry_(registry), body_(body), touch_(touch), rim_(std::max(touch, rim)) {}

  void find_ends() {
    // moving an end moves the face behind it, which another tip may touch then
    for (int before = -1; before != registry_.active_tips();) {
      before = registry_.active_tips();
      for (int c = 0; c < int(cracks().size()); ++c) {
        for (int end = 0; end < 2; ++end) {
          if (state(c, end).state != TipState::active) continue;
          ends_on_rim(c, end) || ends_on_junction(c, end) || ends_on_face(c, end) ||
              ends_on_end(c, end);
        }
      }
    }
  }

  void find_crossings() {
    for (std::size_t a = 0; a < cracks().size(); ++a) {
      for (std::size_t b = a; b < cracks().size(); ++b) {
        const auto &p = cracks()[a].points, &q = cracks()[b].points;
        for (std::size_t k = 0; k + 1 < p.size(); ++k) {
          for (std::size_t l = a == b ? k + 2 : 0; l + 1 < q.size(); ++l) {
            if (boxes_apart(p[k], p[k + 1], q[l], q[l + 1], 0.0)) continue;
            if (!sides_change(p[k], p[k + 1], q[l], q[l + 1])) continue;
            const Vec2 at = crossing_point(p[k], p[k + 1], q[l], q[l + 1]);
            // an end that touches a face does not cross it
            if (ends_at(cracks()[a], at, touch_) || ends_at(cracks()[b], at, touch_)) continue;
            registry_.record({0, 0, EventKind::crossing, int(a), -1, int(b), at});
          }
        }
      }
    }
  }

 private:
  const std::vector<Crack>& cracks() const { return registry_.cracks(); }
  Vec2 place(int c, int end) const { return cracks()[std::size_t(c)].end_point(end); }
  CrackEnd state(int c, int end) const { return cracks()[std::size_t(c)].ends[std::size_t(end)]; }
  bool near(const Vec2& x, const Vec2& y) const { return (x - y).norm() <= touch_; }

  bool end_here(int c, int end, const Vec2& at, TipState becomes, int partner) {
    registry_.place_end(c, end, at);
    registry_.advance(c, end, at, becomes, partner, {});
    return true;
  }

  /// Calls visit(crack, end) for all ends but the given one until it returns true.
  template <class Visit>
  bool any_other_end(int c, int end, Visit visit) const {
    for (int other = 0; other < int(cracks().size()); ++other) {
      for (int far = 0; far < 2; ++far) {
        if ((other != c || far != end) && visit(other, far)) return true;
      }
    }
    return false;
  }

  bool ends_on_rim(int c, int end) {
    const Vec2 rim = nearest_rim_point(body_, place(c, end));
    return (rim - place(c, end)).norm() <= rim_ && end_here(c, end, rim, TipState::boundary, -1);
  }

  /// Where another crack has ended on a face.
  bool ends_on_junction(int c, int end) {
    return any_other_end(c, end, [&](int other, int far) {
      const CrackEnd there = state(other, far);
      if (there.state != TipState::coalesced || !near(place(other, far), place(c, end)))
        return false;
      return end_here(c, end, place(other, far), TipState::coalesced, there.partner);
    });
  }

  bool ends_on_face(int c, int end) {
    const Vec2 x = place(c, end);
    for (int other = 0; other < int(cracks().size()); ++other) {
      const auto& p = cracks()[std::size_t(other)].points;
      const std::size_t behind = end == 0 ? 0 : p.size() - 2;
      for (std::size_t k = 0; k + 1 < p.size(); ++k) {
        const Vec2 foot = foot_on(p[k], p[k + 1], x);
        if (!near(foot, x) || (other == c && k == behind)) continue;
        const bool at_end = any_other_end(
            c, end, [&](int b, int far) { return b == other && near(place(b, far), foot); });
        if (at_end) continue;
        return ends_with_partner(c, end, other) ||
               end_here(c, end, end_or_place(p[k], p[k + 1], foot, touch_), TipState::coalesced,
                        other);
      }
    }
    return false;
  }

  /// Two cracks that run into each other side by side do so in one place.
  bool ends_with_partner(int c, int end, int partner) {
    for (int far = 0; far < 2 && partner != c; ++far) {
      const Vec2 at = place(partner, far);
      if (state(partner, far).partner != c || (at - place(c, end)).norm() > 10 * touch_) continue;
      return end_here(c, end, at, TipState::connected, partner);
    }
    return false;
  }

  bool ends_on_end(int c, int end) {
    return any_other_end(c, end, [&](int other, int far) {
      return near(place(other, far), place(c, end)) &&
             end_here(c, end, place(other, far), TipState::connected, other);
    });
  }

  CrackRegistry& registry_;
  Rectangle body_;
  double touch_;
  double rim_;
};

}  // namespace

void CrackRegistry::resolve_initial_meetings(const Rectangle& body, double touch, double rim) {
  InitialMeetings meetings(*this, body, touch, rim);
  meetings.find_ends();
  meetings.find_crossings();
}

}  // namespace cdca
