// SPDX-License-Identifier: BSD-3-Clause
/// Where two straight segments meet.
#pragma once

#include "core/base/types.hpp"

#include <optional>

namespace cdca {

/// The place where the insides of [a, b] and [c, d] cross, as fractions of both; no value when they
/// do not cross or are parallel.
struct SegmentCrossing {
  double on_first;
  double on_second;
};

inline std::optional<SegmentCrossing> crossing_of(const Vec2& a, const Vec2& b, const Vec2& c,
                                                  const Vec2& d) {
  const Vec2 u = b - a, v = d - c, w = c - a;
  const double area = cross(u, v);
  if (std::abs(area) <= 1e-14 * u.norm() * v.norm()) return std::nullopt;
  const double s = cross(w, v) / area, t = cross(w, u) / area;
  if (s <= 0.0 || s >= 1.0 || t <= 0.0 || t >= 1.0) return std::nullopt;
  return SegmentCrossing{s, t};
}

/// Are the boxes round [a, b] and [c, d] farther apart than `margin`?
inline bool boxes_apart(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double margin) {
  return (a.cwiseMax(b).array() + margin < c.cwiseMin(d).array()).any() ||
         (c.cwiseMax(d).array() + margin < a.cwiseMin(b).array()).any();
}

}  // namespace cdca
