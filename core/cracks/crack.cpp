// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/crack.hpp"

#include <algorithm>

namespace cdca {

const char* name_of(TipState state) {
  switch (state) {
    case TipState::active: return "active";
    case TipState::boundary: return "boundary";
    case TipState::connected: return "connected";
    case TipState::coalesced: return "coalesced";
  }
  return "?";
}

std::optional<int> CrackEnd::points_past_tip() const {
  if (state == TipState::active) return 0;
  return tip_was < 0 ? std::nullopt : std::optional<int>(tip_was);
}

double Crack::length() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < segments(); ++k) sum += (points[k + 1] - points[k]).norm();
  return sum;
}

Vec2 Crack::end_tangent(int end) const {
  const std::size_t n = points.size();
  return (end == 0 ? points[0] - points[1] : points[n - 1] - points[n - 2]).normalized();
}

std::vector<Vec2> Crack::seen_from(int end, int points_back) const {
  std::vector<Vec2> path = points;
  if (end == 1) std::reverse(path.begin(), path.end());
  path.erase(path.begin(), path.begin() + points_back);
  return path;
}

double nearest_fraction(const Vec2& a, const Vec2& b, const Vec2& x) {
  const Vec2 d = b - a;
  const double squared = d.squaredNorm();
  return squared > 0.0 ? std::clamp((x - a).dot(d) / squared, 0.0, 1.0) : 0.0;
}

Vec2 foot_on(const Vec2& a, const Vec2& b, const Vec2& x) {
  return a + nearest_fraction(a, b, x) * (b - a);
}

Vec2 end_or_place(const Vec2& a, const Vec2& b, const Vec2& x, double touch) {
  const double to_a = (x - a).norm(), to_b = (x - b).norm();
  if (std::min(to_a, to_b) > touch) return x;
  return to_a <= to_b ? a : b;
}

}  // namespace cdca
