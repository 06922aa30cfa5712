// SPDX-License-Identifier: BSD-3-Clause
/// A crack: a polyline with two ends, each of them a tip as long as it can still grow.
#pragma once

#include "core/base/types.hpp"

#include <array>
#include <compare>
#include <optional>
#include <string>
#include <vector>

namespace cdca {

/// What has become of an end of a crack (sections 4.1 and 4.2 of the paper).
enum class TipState : std::int32_t {
  active,     ///< a tip: it has near-tip functions and may grow
  boundary,   ///< ends on the rim of the body (4.1)
  connected,  ///< met the end of another crack (4.2.1)
  coalesced,  ///< ends on the face of another crack (4.2.2)
};

const char* name_of(TipState state);

/// When cracks grow: a growth cycle of a load step. In load step 0 initial cracks are put in place.
struct GrowthTime {
  int step = 0;
  int cycle = 0;
  friend auto operator<=>(const GrowthTime&, const GrowthTime&) = default;
};

struct CrackEnd {
  TipState state = TipState::active;
  int partner = -1;  ///< number of the crack that was met, or -1
  /// For an end that growth has joined: how many points back from it the tip was then. -1 for ends
  /// that have never been a tip.
  int tip_was = -1;
  GrowthTime joined;  ///< when that was

  /// How many points back from the end the tip is, or was; none if it never was one.
  std::optional<int> points_past_tip() const;
};

struct Crack {
  std::string name;
  std::vector<Vec2> points;      ///< m, from end 0 to end 1
  std::vector<GrowthTime> born;  ///< when each segment appeared
  std::array<CrackEnd, 2> ends;

  std::size_t segments() const { return points.size() - 1; }
  double length() const;
  /// Position of end 0 or 1.
  const Vec2& end_point(int end) const { return end == 0 ? points.front() : points.back(); }
  /// Unit vector out of the crack at its end.
  Vec2 end_tangent(int end) const;
  /// The polyline seen from an end, or from a point so many points back from it: its position
  /// first, then backwards along the crack.
  std::vector<Vec2> seen_from(int end, int points_back = 0) const;
};

/// The point of segment [a, b] nearest to x, as a fraction of the segment.
double nearest_fraction(const Vec2& a, const Vec2& b, const Vec2& x);
/// That point itself.
Vec2 foot_on(const Vec2& a, const Vec2& b, const Vec2& x);
/// x, or the end of the segment that is nearer to it than `touch`.
Vec2 end_or_place(const Vec2& a, const Vec2& b, const Vec2& x, double touch);

}  // namespace cdca
