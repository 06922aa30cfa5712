// SPDX-License-Identifier: BSD-3-Clause
/// Paths of grown cracks beside reference paths.
#pragma once

#include "core/cracks/crack.hpp"
#include "core/simulation/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace cdca::testing {

using Path = std::vector<Vec2>;

inline double distance_to(const Path& path, const Vec2& x) {
  double nearest = 1e300;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const Vec2 foot = path[k] + nearest_fraction(path[k], path[k + 1], x) * (path[k + 1] - path[k]);
    nearest = std::min(nearest, (foot - x).norm());
  }
  return nearest;
}

/// The largest distance of the points from a path.
inline double farthest(const std::vector<Vec2>& points, const Path& path) {
  double distance = 0.0;
  for (const Vec2& x : points) distance = std::max(distance, distance_to(path, x));
  return distance;
}

/// The path as seen from one of its ends.
inline Path seen_from(int end, Path path) {
  if (end == 1) std::reverse(path.begin(), path.end());
  return path;
}

/// What an end of an initial crack has grown: from its first tip on; one point if it has not grown.
inline Path grown_part(const Path& initial, const Path& grown, int end) {
  const Path from_tip = seen_from(end, grown);
  const Vec2 tip = end == 0 ? initial.front() : initial.back();
  const double touch = 1e-6 * (initial.back() - initial.front()).norm();
  const auto at = std::find_if(from_tip.begin(), from_tip.end(),
                               [&](const Vec2& x) { return (x - tip).norm() < touch; });
  Path wing(from_tip.begin(), at == from_tip.end() ? at : at + 1);
  std::reverse(wing.begin(), wing.end());
  return wing;
}

inline double length_of(const Path& path) {
  double sum = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) sum += (path[k] - path[k - 1]).norm();
  return sum;
}

/// The points of a path up to a length from its beginning.
inline Path up_to(const Path& path, double length) {
  Path part;
  double sum = 0.0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (k > 0) sum += (path[k] - path[k - 1]).norm();
    if (sum <= length) part.push_back(path[k]);
  }
  return part;
}

/// The angle from a straight crack to the first step at one of its ends, degrees counter-clockwise;
/// nothing when the end has not grown.
inline std::optional<double> first_kink(const Path& initial, const Path& grown, int end) {
  const Path wing = grown_part(initial, grown, end);
  if (wing.size() < 2) return std::nullopt;
  const Path crack = seen_from(1 - end, initial);  // ends at the tip
  const Vec2 before = crack.back() - crack.front(), after = wing[1] - wing[0];
  return std::atan2(cross(before, after), before.dot(after)) * 180 / std::numbers::pi;
}

}  // namespace cdca::testing
