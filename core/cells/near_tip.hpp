// SPDX-License-Identifier: BSD-3-Clause
/// The near-tip functions of Eq. 5, in polar coordinates that follow the bent crack.
#pragma once

#include "core/base/types.hpp"

#include <array>
#include <vector>

namespace cdca {

/// Side of the crack for points on it: they belong to either face.
enum class FaceSide { minus = -1, none = 0, plus = 1 };

/// Polar coordinates of a place as seen from a tip. The angle is measured from the tip's tangent
/// and is +pi and -pi on the faces of the crack, however the crack bends behind its tip.
struct TipPolar {
  double r = 0.0;      ///< m
  double theta = 0.0;  ///< rad
  Vec2 grad_r{0, 0};
  Vec2 grad_theta{0, 0};  ///< 1/m
};

struct NearTipValues {
  std::array<double, 4> value;   ///< m^1/2
  std::array<Vec2, 4> gradient;  ///< m^-1/2
};

/// sqrt(r) times sin(t/2), cos(t/2), sin(t) sin(t/2), sin(t) cos(t/2) (Eq. 5).
NearTipValues near_tip_functions(const TipPolar& polar);

/// The frame of one tip.
///
/// The crack behind the tip is seen at distance r under the angle pi + bend(r) from the tangent.
/// With g = alpha - bend(r) in (-pi, pi), the angle used is theta = g + bend (1 + cos g) / 2:
/// smooth in the uncracked material, exactly +-pi on the faces, and the plain angle for a straight
/// crack.
class TipFrame {
 public:
  TipFrame() = default;
  /// path: from the tip backwards along the crack, m. end_is_open: beyond the far end of the path
  /// there is uncracked material.
  TipFrame(std::vector<Vec2> path, bool end_is_open);

  const Vec2& tip() const { return path_.front(); }
  /// The part of the crack that the frame follows, from the tip backwards, m.
  const std::vector<Vec2>& path() const { return path_; }
  const Vec2& tangent() const { return tangent_; }
  /// Length of the straight segment at the tip, m.
  double straight_length() const { return straight_; }
  /// Up to this distance from the tip the functions open the crack and nothing else, m. It ends
  /// where the crack turns back towards its tip, bends by more than 110 degrees, or stops.
  double valid_radius() const { return valid_; }
  /// Distances at which the crack bends, m: there the functions have a kink.
  std::vector<double> bends() const;

  /// x in m. `side` says to which face a point on (or close to) the crack belongs; plus is on the
  /// left of the way towards the tip.
  TipPolar polar(const Vec2& x, FaceSide side = FaceSide::none) const;
  /// As seen from a place inside the same convex piece of material (m): on a face of the crack, and
  /// on one of another that ends at this tip, the angle goes on from that of the place.
  TipPolar polar_beside(const Vec2& x, const Vec2& inside) const;
  /// Angle from the tangent, from -pi + bend to pi + bend: it goes on past pi up to the faces of a
  /// bent crack, so that fields continued by it jump across the crack and nowhere else.
  double angle(const Vec2& x, FaceSide side = FaceSide::none) const;
  /// Unrolled for a straight crack: a point's coordinates along and across the tangent, m.
  Vec2 local(const Vec2& x) const;
  /// Does the segment [a, b] (m) prolong the straight crack behind the tip, within `limit` (m)? To
  /// the tip, that is no other crack.
  bool is_prolonged_by(const Vec2& a, const Vec2& b, double limit) const;

 private:
  struct Bend {
    double angle;  ///< rad
    double slope;  ///< d angle / d r, rad/m
  };
  Bend bend(double r) const;
  /// Angle from the crack's own direction at distance r, -pi to pi; beyond it on the given side.
  double angle_from_crack(const Vec2& local, const Bend& bend, FaceSide side) const;
  TipPolar polar_at(const Vec2& x, double r, const Bend& bend, double angle_from_crack) const;

  std::vector<Vec2> path_;
  std::vector<double> radius_;  ///< distance of every path point from the tip
  Vec2 tangent_{1, 0};
  double straight_ = 0.0;
  double valid_ = 0.0;
};

}  // namespace cdca
