// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/fracture_criterion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cdca {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double widest = 2.0 / 3.0 * pi;
constexpr int samples = 480;

}  // namespace

double hoop_angle(double k1, double k2) {
  k1 = std::max(k1, 0.0);
  if (k2 == 0.0) return 0.0;
  return 2 * std::atan((k1 - std::sqrt(k1 * k1 + 8 * k2 * k2)) / (4 * k2));
}

double hoop_intensity(double k1, double k2, double t) {
  const double c = std::cos(t / 2);
  return c * (std::max(k1, 0.0) * c * c - 1.5 * k2 * std::sin(t));
}

double griffith_index(double normal, double shear, double tensile_strength) {
  return (normal + std::hypot(normal, shear)) / (2 * tensile_strength);
}

double coulomb_index(double normal, double shear, double cohesion, double friction_angle) {
  if (normal >= 0.0) return 0.0;
  return std::max(0.0, (std::abs(shear) + normal * std::tan(friction_angle)) / cohesion);
}

std::optional<double> Strength::critical_distance() const {
  if (!tensile || !toughness) return std::nullopt;
  const double ratio = *toughness / *tensile;
  return ratio * ratio / (2 * pi);
}

const char* name_of(FractureMode mode) {
  switch (mode) {
    case FractureMode::none: return "none";
    case FractureMode::tension: return "tension";
    case FractureMode::mixed: return "mixed";
    case FractureMode::shear: return "shear";
    case FractureMode::hoop: return "hoop";
  }
  return "?";
}

std::vector<ArcSample> singular_arc(double k1, double k2, double r) {
  k1 = std::max(k1, 0.0);
  std::vector<ArcSample> arc;
  const double root = 1 / std::sqrt(2 * pi * r);
  for (int k = 0; k <= samples; ++k) {
    const double t = -widest + 2 * widest * k / samples, c = std::cos(t / 2), s = std::sin(t);
    arc.push_back({t, root * c * (k1 * c * c - 1.5 * k2 * s),
                   root * 0.5 * c * (k1 * s + k2 * (3 * std::cos(t) - 1))});
  }
  return arc;
}

TipJudgement judge_hoop(double k1, double k2, const Strength& strength) {
  TipJudgement judgement;
  judgement.tensile_angle = hoop_angle(k1, k2);
  judgement.u_tension =
      hoop_intensity(k1, k2, judgement.tensile_angle) / strength.toughness.value();
  judgement.tensile_mode = FractureMode::hoop;
  return judgement;
}

TipJudgement judge_mixed(const std::vector<ArcSample>& arc, const std::vector<ArcSample>& full,
                         double scale, const Strength& strength) {
  TipJudgement judgement;
  if (arc.empty()) return judgement;
  std::vector<double> u;
  for (const ArcSample& a : arc) {
    u.push_back(scale * griffith_index(a.normal, a.shear, strength.tensile.value()));
  }
  // equal peaks (pure shear of either sign) are told apart by the first one, on every rank alike
  const auto best = std::size_t(std::max_element(u.begin(), u.end()) - u.begin());
  judgement.u_tension = u[best];
  judgement.tensile_angle = arc[best].angle;
  if (best > 0 && best + 1 < u.size()) {
    const double left = u[best - 1], right = u[best + 1], bow = left - 2 * u[best] + right;
    const double step = 0.5 * (arc[best + 1].angle - arc[best - 1].angle);
    if (bow < 0.0 && step < 0.1) {
      const double shift = 0.5 * (left - right) / bow;
      judgement.tensile_angle += shift * step;
      judgement.u_tension -= 0.25 * (left - right) * shift;
    }
  }
  const ArcSample& at = arc[best];
  judgement.tensile_mode =
      std::abs(judgement.tensile_angle) < 1e-3 && std::abs(at.shear) < 1e-2 * std::abs(at.normal)
          ? FractureMode::tension
          : FractureMode::mixed;
  if (full.empty() || !strength.cohesion || !strength.friction_angle) return judgement;
  const auto most = std::max_element(full.begin(), full.end(), [](const auto& a, const auto& b) {
    return std::abs(a.shear) < std::abs(b.shear);
  });
  judgement.shear_angle = most->angle;
  judgement.u_shear =
      coulomb_index(most->normal, most->shear, *strength.cohesion, *strength.friction_angle);
  return judgement;
}

}  // namespace cdca
