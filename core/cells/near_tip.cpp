// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/near_tip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cdca {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double largest_bend = 110.0 / 180.0 * pi;
/// rad from the crack's prolongation: a place farther round is taken for one on or close to a face
/// of the crack, if no place beside it tells. Growth by the hoop stress (70.5 degrees at most) that
/// turns to what it joins (60 more) does not come so far.
constexpr double at_face = 135.0 / 180.0 * pi;
constexpr double straight_on = 1e-9;  ///< rad: bends less than this do not show
}  // namespace

NearTipValues near_tip_functions(const TipPolar& p) {
  const double root = std::sqrt(p.r), s2 = std::sin(p.theta / 2), c2 = std::cos(p.theta / 2);
  const double s = 2 * s2 * c2, c = c2 * c2 - s2 * s2;
  const std::array<double, 4> angular{s2, c2, s * s2, s * c2};
  const std::array<double, 4> derivative{c2 / 2, -s2 / 2, c * s2 + s * c2 / 2, c * c2 - s * s2 / 2};
  NearTipValues f;
  for (std::size_t l = 0; l < 4; ++l) {
    f.value[l] = root * angular[l];
    f.gradient[l] =
        p.r > 0 ? Vec2(angular[l] / (2 * root) * p.grad_r + root * derivative[l] * p.grad_theta)
                : Vec2(0, 0);
  }
  return f;
}

TipFrame::TipFrame(std::vector<Vec2> path, bool end_is_open) : path_(std::move(path)) {
  tangent_ = (path_[0] - path_[1]).normalized();
  straight_ = (path_[0] - path_[1]).norm();
  radius_.push_back(0.0);
  valid_ = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < path_.size(); ++k) {
    radius_.push_back((path_[k] - path_[0]).norm());
    // the first place where the distance stops growing, or the path leaves the sector
    const Vec2 d = path_[k] - path_[k - 1], out = path_[k - 1] - path_[0];
    const Vec2 back = path_[k] - path_[0];
    const double angle = std::atan2(cross(-tangent_, back), -tangent_.dot(back));
    if (k > 1 && (out.dot(d) <= 0.0 || std::abs(angle) > largest_bend)) {
      valid_ = radius_[k - 1];
      path_.resize(k);
      radius_.resize(k);
      return;
    }
  }
  if (end_is_open) valid_ = radius_.back();
}

std::vector<double> TipFrame::bends() const {
  std::vector<double> found;
  for (std::size_t k = 1; k + 1 < path_.size(); ++k) {
    const Vec2 out = (path_[k] - path_[k - 1]).normalized();
    if (std::abs(cross(out, (path_[k + 1] - path_[k]).normalized())) > straight_on)
      found.push_back(radius_[k]);
  }
  return found;
}

Vec2 TipFrame::local(const Vec2& x) const {
  const Vec2 d = x - tip();
  return {d.dot(tangent_), cross(tangent_, d)};
}

bool TipFrame::is_prolonged_by(const Vec2& a, const Vec2& b, double limit) const {
  const Vec2 p = local(a), q = local(b);
  return std::max(std::abs(p.y()), std::abs(q.y())) < limit && std::max(p.x(), q.x()) < limit;
}

TipFrame::Bend TipFrame::bend(double r) const {
  if (r <= radius_[1] || path_.size() == 2) return {0.0, 0.0};
  std::size_t k = 1;
  while (k + 2 < radius_.size() && radius_[k + 1] < r) ++k;
  // the last segment is prolonged; r^2 = |a|^2 + 2 s a.d + s^2
  const Vec2 a = path_[k] - path_[0], d = (path_[k + 1] - path_[k]).normalized();
  const double ad = a.dot(d);
  const double s = -ad + std::sqrt(std::max(0.0, ad * ad + r * r - a.squaredNorm()));
  const Vec2 p = a + s * d;
  // d angle / ds = p x d / r^2 and dr / ds = p.d / r
  return {std::atan2(cross(-tangent_, p), -tangent_.dot(p)),
          cross(p, d) / (r * std::max(p.dot(d), 1e-3 * r))};
}

double TipFrame::angle_from_crack(const Vec2& local, const Bend& bend, FaceSide side) const {
  double g = std::atan2(local.y(), local.x()) - bend.angle;
  if (g > pi) g -= 2 * pi;
  if (g < -pi) g += 2 * pi;
  // seen from the other face the angle goes on beyond +-pi instead of jumping
  if (side == FaceSide::plus && g < -at_face) g += 2 * pi;
  if (side == FaceSide::minus && g > at_face) g -= 2 * pi;
  return g;
}

double TipFrame::angle(const Vec2& x, FaceSide side) const {
  const Vec2 d = local(x);
  const Bend b = bend(d.norm());
  return angle_from_crack(d, b, side) + b.angle;
}

TipPolar TipFrame::polar(const Vec2& x, FaceSide side) const {
  const Vec2 d = local(x);
  const Bend b = bend(d.norm());
  return polar_at(x, d.norm(), b, angle_from_crack(d, b, side));
}

TipPolar TipFrame::polar_beside(const Vec2& x, const Vec2& inside) const {
  const Vec2 d = local(x), from = local(inside);
  const Bend b = bend(d.norm());
  double g = angle_from_crack(d, b, FaceSide::none);
  const double seen_from = angle_from_crack(from, bend(from.norm()), FaceSide::none);
  // a convex piece is seen from the tip within half a turn
  if (g - seen_from > pi) g -= 2 * pi;
  if (g - seen_from < -pi) g += 2 * pi;
  return polar_at(x, d.norm(), b, g);
}

TipPolar TipFrame::polar_at(const Vec2& x, double r, const Bend& b, double g) const {
  TipPolar polar;
  polar.r = r;
  if (r == 0.0) return polar;
  const Vec2 radial = (x - tip()) / r;
  const bool bent = b.angle != 0.0 || b.slope != 0.0;  // else sine and cosine do not count
  const double sine = bent ? std::sin(g) : 0.0, cosine = bent ? std::cos(g) : 0.0;
  polar.theta = g + b.angle * (1 + cosine) / 2;
  const double by_g = 1 - b.angle * sine / 2, by_bend = (1 + cosine) / 2;
  polar.grad_r = radial;
  polar.grad_theta = by_g / r * turned_left(radial) + b.slope * (by_bend - by_g) * radial;
  return polar;
}

}  // namespace cdca
