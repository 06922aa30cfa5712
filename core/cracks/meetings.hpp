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
///  - boundary (4.1): a rim point nearer than the increment is long, ahead of the tip, or where the
///    increment leaves the body;
///  - coalescence (4.2.2): the face of a crack, its own included, that it crosses or that lies
///    ahead and nearer than it is long; the tip of a crack that does not grow now is a connection;
///  - connection (4.2.1): two increments that cross both end at the crossing; two tips that head
///    for each other, and whose increments reach each other, meet between their places.
/// Ahead means within 60 degrees of the direction. Nearness does not count for what the tip's last
/// segment comes from. What comes nearer than `touch` (m) counts as met.
///
/// The earliest meeting along the increments comes first, ties by crack and end. An increment that
/// has ended causes no meetings further on, and those that come across it later end on it. The
/// order of the result is by crack and end.
std::vector<Increment> resolve_meetings(const CrackRegistry& registry, const Rectangle& body,
                                        double touch, std::vector<Increment> increments);

/// Applies resolved increments of one growth cycle. One that ends within `touch` (m) of the tip
/// moves it there and adds no segment.
void apply_increments(const std::vector<Increment>& increments, double touch,
                      const GrowthTime& when, CrackRegistry& registry);

}  // namespace cdca
