// SPDX-License-Identifier: BSD-3-Clause
/// What a straight increment of a crack can end on: segments of cracks, and the rim of the body.
#pragma once

#include "core/cracks/crack_registry.hpp"

#include <optional>

namespace cdca {

/// A place on the way of an increment.
struct WayHit {
  double distance = 0.0;  ///< along the way, m
  Vec2 at{0, 0};          ///< m
};

/// Where the way from `from` to `to` meets the segment a-b: where they cross, where it passes an
/// end of the segment nearer than `touch` (m), or where its own end comes that near to the segment.
/// A place that near to a or b is a or b itself. What lies within touch of `from` does not count,
/// unless it is crossed.
std::optional<WayHit> hit_of(const Vec2& from, const Vec2& to, const Vec2& a, const Vec2& b,
                             double touch);

/// Does x lie ahead of a tip: within 60 degrees of the direction (of any length)?
bool lies_ahead(const Vec2& tip, const Vec2& direction, const Vec2& x);

/// The end of an increment on something that was there before it.
struct Target {
  double distance = 0.0;  ///< from the tip along the way to it, m
  Vec2 at{0, 0};
  TipState state = TipState::coalesced;
  int partner = -1;
};

/// The rim and the cracks as they are, seen from one tip that makes a straight step.
class Obstacles {
 public:
  Obstacles(const CrackRegistry& registry, const Rectangle& body, double touch)
      : registry_(registry), body_(body), touch_(touch) {}

  /// The first of what the step from the tip (crack, end) to `to` meets on its way, and of what
  /// lies nearer to the tip than the step is long, ahead of it, and is not what the tip's last
  /// segment comes from.
  std::optional<Target> target_of(int crack, int end, const Vec2& to) const;
  /// The first of what lies on the way itself.
  std::optional<Target> on_the_way(int crack, int end, const Vec2& to) const;

 private:
  /// Calls visit(crack, a, b) for all segments but the one at the tip.
  template <class Visit>
  void for_segments(int crack, int end, Visit visit) const;
  std::optional<Target> nearest_ahead(int crack, int end, const Vec2& to) const;
  /// The mouth of a crack on the rim within touch of x, or x.
  Vec2 on_mouth(const Vec2& x) const;

  const CrackRegistry& registry_;
  Rectangle body_;
  double touch_;
};

}  // namespace cdca
