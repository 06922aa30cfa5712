// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/meetings.hpp"

#include "core/cracks/segments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cdca {

namespace {

constexpr double ahead_cosine = 0.5;  // within 60 degrees of the growth direction

/// A place where an increment can end.
struct Target {
  double distance = std::numeric_limits<double>::infinity();  ///< from the tip, m
  Vec2 at{0, 0};
  TipState state = TipState::active;
  int partner = -1;
  int partner_end = -1;

  bool found() const { return std::isfinite(distance); }
};

bool lies_ahead(const Increment& inc, const Vec2& at) {
  const Vec2 d = at - inc.from;
  return d.norm() > 0.0 && d.dot(inc.direction()) >= ahead_cosine * d.norm();
}

void keep_nearer(Target& best, const Target& other) {
  if (other.distance < best.distance) best = other;
}

Target rim_target(const Increment& inc, const Rectangle& body) {
  Target best;
  const std::array<Vec2, 4> feet{
      Vec2(body.lower.x(), inc.from.y()), Vec2(body.upper.x(), inc.from.y()),
      Vec2(inc.from.x(), body.lower.y()), Vec2(inc.from.x(), body.upper.y())};
  for (const Vec2& foot : feet) {
    const double d = (foot - inc.from).norm();
    if (d <= inc.length() && lies_ahead(inc, foot))
      keep_nearer(best, {d, foot, TipState::boundary});
  }
  if (best.found()) return best;
  // a grazing increment may leave the body though the nearest rim point lies aside
  for (int axis = 0; axis < 2; ++axis) {
    for (const double rim : {body.lower[axis], body.upper[axis]}) {
      const bool leaves =
          (inc.to[axis] - rim) * (inc.from[axis] - rim) <= 0 && inc.to[axis] != inc.from[axis];
      if (!leaves) continue;
      const double t = (rim - inc.from[axis]) / (inc.to[axis] - inc.from[axis]);
      Vec2 at = inc.from + t * (inc.to - inc.from);
      at[axis] = rim;
      keep_nearer(best, {t * inc.length(), at, TipState::boundary});
    }
  }
  return best;
}

/// An end of a crack that is met counts as a meeting of two ends.
Target with_end(const Target& target, const Crack& crack) {
  Target t = target;
  for (int end = 0; end < 2; ++end) {
    if ((crack.end_point(end) - t.at).norm() > 1e-9 * (1 + t.at.norm())) continue;
    if (crack.ends[std::size_t(end)].state != TipState::active) continue;
    t.state = TipState::connected;
    t.partner_end = end;
  }
  return t;
}

Target face_target(const Increment& inc, const CrackRegistry& registry) {
  Target best;
  for (std::size_t c = 0; c < registry.cracks().size(); ++c) {
    const Crack& crack = registry.cracks()[c];
    const bool own = int(c) == inc.crack;
    for (std::size_t k = 0; k < crack.segments(); ++k) {
      const Vec2 &a = crack.points[k], &b = crack.points[k + 1];
      if (own && (a == inc.from || b == inc.from)) continue;
      if (const auto hit = crossing_of(inc.from, inc.to, a, b)) {
        const Vec2 at = inc.from + hit->on_first * (inc.to - inc.from);
        keep_nearer(best, {hit->on_first * inc.length(), at, TipState::coalesced, int(c)});
      }
      if (own) continue;
      const Vec2 foot = a + nearest_fraction(a, b, inc.from) * (b - a);
      const double d = (foot - inc.from).norm();
      if (d <= inc.length() && lies_ahead(inc, foot)) {
        keep_nearer(best, with_end({d, foot, TipState::coalesced, int(c)}, crack));
      }
    }
  }
  return best;
}

struct Crossing {
  double later;  ///< the longer of both ways to the crossing, m
  std::size_t first, second;
  Vec2 at;
};

/// Increments that cross end there, the earliest crossing first; what is cut short may miss a
/// later one.
void connect_crossing(std::vector<Increment>& incs) {
  for (;;) {
    Crossing best{std::numeric_limits<double>::infinity(), 0, 0, {0, 0}};
    for (std::size_t a = 0; a < incs.size(); ++a) {
      for (std::size_t b = a + 1; b < incs.size(); ++b) {
        const auto hit = crossing_of(incs[a].from, incs[a].to, incs[b].from, incs[b].to);
        if (!hit) continue;
        const double later =
            std::max(hit->on_first * incs[a].length(), hit->on_second * incs[b].length());
        if (later < best.later) {
          best = {later, a, b, incs[a].from + hit->on_first * (incs[a].to - incs[a].from)};
        }
      }
    }
    if (!std::isfinite(best.later)) return;
    Increment &one = incs[best.first], &two = incs[best.second];
    one.to = two.to = best.at;
    one.state = two.state = TipState::connected;
    one.partner = two.crack;
    one.partner_end = two.end;
    two.partner = one.crack;
    two.partner_end = one.end;
  }
}

}  // namespace

std::vector<Increment> resolve_meetings(const CrackRegistry& registry, const Rectangle& body,
                                        std::vector<Increment> incs) {
  std::sort(incs.begin(), incs.end(), [](const Increment& a, const Increment& b) {
    return a.crack != b.crack ? a.crack < b.crack : a.end < b.end;
  });
  for (Increment& inc : incs) {
    Target target = rim_target(inc, body);
    keep_nearer(target, face_target(inc, registry));
    if (!target.found()) continue;
    inc.to = target.at;
    inc.state = target.state;
    inc.partner = target.partner;
    inc.partner_end = target.partner_end;
  }
  connect_crossing(incs);
  return incs;
}

}  // namespace cdca
