// SPDX-License-Identifier: BSD-3-Clause
/// What growing tips run into (sections 4.1 and 4.2 of the paper).
#pragma once

#include "core/cracks/crack_registry.hpp"

#include <vector>

namespace cdca {

/// An increment that a tip is to make, as a straight line; after resolve_meetings() with the place
/// and the state in which the tip ends.
struct Increment {
  int crack = 0;
  int end = 0;
  Vec2 from{0, 0};                    ///< m, the tip
  Vec2 to{0, 0};                      ///< m
  TipState state = TipState::active;  ///< of the tip afterwards
  int partner = -1;
  int partner_end = -1;  ///< the other crack's end, when that is what was met

  Vec2 direction() const { return (to - from).normalized(); }
  double length() const { return (to - from).norm(); }
};

/// Lets every increment end where it meets the rim, a crack or another increment:
///  - a rim point nearer than the increment is long, and within 60 degrees of its direction, ends
///    the crack there (4.1);
///  - so does the face of another crack (4.2.2), or the crack's own face where the increment
///    crosses it;
///  - two increments that cross both end at the crossing (4.2.1).
/// Earlier meetings along the increments come first, ties by crack and end.
std::vector<Increment> resolve_meetings(const CrackRegistry& registry, const Rectangle& body,
                                        std::vector<Increment> increments);

}  // namespace cdca
