// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/obstacles.hpp"

#include "core/cracks/segments.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

namespace {

constexpr double ahead_cosine = 0.5;  // within 60 degrees

void keep_first(std::optional<WayHit>& best, const WayHit& other) {
  if (!best || other.distance < best->distance) best = other;
}

void keep_first(std::optional<Target>& best, const Target& other) {
  if (!best || other.distance < best->distance) best = other;
}

/// The four sides of the body: the axis that they are normal to, and their place on it.
struct RimSide {
  int axis;
  double place;
  double outward;
};

std::array<RimSide, 4> sides_of(const Rectangle& body) {
  return {{{0, body.lower.x(), -1},
           {0, body.upper.x(), 1},
           {1, body.lower.y(), -1},
           {1, body.upper.y(), 1}}};
}

}  // namespace

std::optional<WayHit> hit_of(const Vec2& from, const Vec2& to, const Vec2& a, const Vec2& b,
                             double touch) {
  if (boxes_apart(from, to, a, b, touch)) return std::nullopt;
  const double length = (to - from).norm();
  std::optional<WayHit> first;
  if (const auto hit = crossing_of(from, to, a, b)) {
    const Vec2 at = from + hit->on_first * (to - from);
    first = WayHit{hit->on_first * length, end_or_place(a, b, at, touch)};
  }
  for (const Vec2& x : {a, b}) {
    const double t = nearest_fraction(from, to, x);
    const bool near = (from + t * (to - from) - x).norm() <= touch;
    if (near && t * length > touch) keep_first(first, {t * length, x});
  }
  const Vec2 foot = foot_on(a, b, to);
  if ((foot - to).norm() <= touch) keep_first(first, {length, end_or_place(a, b, foot, touch)});
  return first;
}

bool lies_ahead(const Vec2& tip, const Vec2& direction, const Vec2& x) {
  const Vec2 d = x - tip;
  return d.dot(direction) >= ahead_cosine * d.norm() * direction.norm() && d.norm() > 0.0;
}

template <class Visit>
void Obstacles::for_segments(int own, int end, Visit visit) const {
  const auto& cracks = registry_.cracks();
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    const auto& points = cracks[c].points;
    const std::size_t at_tip = end == 0 ? 0 : points.size() - 2;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      if (int(c) != own || k != at_tip) visit(int(c), points[k], points[k + 1]);
    }
  }
}

std::optional<Target> Obstacles::on_the_way(int crack, int end, const Vec2& to) const {
  const Vec2 from = registry_.cracks()[std::size_t(crack)].end_point(end);
  const Vec2 way = to - from;
  std::optional<Target> first;
  for (const RimSide& side : sides_of(body_)) {
    const double gap = side.outward * (side.place - to[side.axis]);
    if (gap > touch_ || side.outward * way[side.axis] <= 0.0) continue;
    const double t = std::min(1.0, (side.place - from[side.axis]) / way[side.axis]);
    Vec2 at = (from + t * way).cwiseMax(body_.lower).cwiseMin(body_.upper);
    at[side.axis] = side.place;
    keep_first(first, {t * way.norm(), on_mouth(at), TipState::boundary});
  }
  for_segments(crack, end, [&](int other, const Vec2& a, const Vec2& b) {
    if (const auto hit = hit_of(from, to, a, b, touch_))
      keep_first(first, {hit->distance, hit->at, TipState::coalesced, other});
  });
  return first;
}

std::optional<Target> Obstacles::nearest_ahead(int crack, int end, const Vec2& to) const {
  const auto path = registry_.cracks()[std::size_t(crack)].seen_from(end);
  const Vec2 &tip = path[0], &left = path[1];  // the last segment comes from there
  const double step = (to - tip).norm();
  std::optional<Target> nearest;
  const auto consider = [&](const Vec2& at, TipState state, int partner) {
    const double d = (at - tip).norm();
    if (d <= step && lies_ahead(tip, to - tip, at)) keep_first(nearest, {d, at, state, partner});
  };
  for (const RimSide& side : sides_of(body_)) {
    if (std::abs(left[side.axis] - side.place) <= touch_) continue;
    Vec2 at = tip;
    at[side.axis] = side.place;
    consider(on_mouth(at), TipState::boundary, -1);
  }
  for_segments(crack, end, [&](int other, const Vec2& a, const Vec2& b) {
    if ((foot_on(a, b, left) - left).norm() <= touch_) return;
    consider(end_or_place(a, b, foot_on(a, b, tip), touch_), TipState::coalesced, other);
  });
  return nearest;
}

std::optional<Target> Obstacles::target_of(int crack, int end, const Vec2& to) const {
  std::optional<Target> first = on_the_way(crack, end, to);
  const auto nearest = nearest_ahead(crack, end, to);
  if (!nearest || (first && first->distance <= nearest->distance)) return first;
  // the way to it is another one, which may cross what lies aside
  const auto before = on_the_way(crack, end, nearest->at);
  if (before && before->distance < nearest->distance - touch_) return before;
  return nearest;
}

Vec2 Obstacles::on_mouth(const Vec2& x) const {
  for (const Crack& crack : registry_.cracks()) {
    for (int end = 0; end < 2; ++end) {
      if (crack.ends[std::size_t(end)].state != TipState::boundary) continue;
      if ((crack.end_point(end) - x).norm() <= touch_) return crack.end_point(end);
    }
  }
  return x;
}

}  // namespace cdca
