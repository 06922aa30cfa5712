// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/williams.hpp"

#include <cmath>
#include <numbers>

namespace cdca {

WilliamsField williams_field(const Material& material, int mode, double r, double theta) {
  const double kappa = material.kolosov(), mu = material.shear();
  const double c = std::cos(theta / 2), s = std::sin(theta / 2);
  const double c2 = c * c - s * s, s2 = 2 * s * c;  // of theta
  const double c3 = c * c2 - s * s2, s3 = s * c2 + c * s2;
  const double amplitude = std::sqrt(r / (2 * std::numbers::pi)) / (2 * mu);
  // u = amplitude f(theta), f' its derivative
  Vec2 f, df;
  WilliamsField field;
  const double root = 1 / std::sqrt(2 * std::numbers::pi * r);
  if (mode == 1) {
    f = {(kappa - 0.5) * c - 0.5 * c3, (kappa + 0.5) * s - 0.5 * s3};
    df = {-0.5 * (kappa - 0.5) * s + 0.75 * s3, 0.5 * (kappa + 0.5) * c - 0.75 * c3};
    field.stress = root * Voigt(c * (1 - s * s3), c * (1 + s * s3), c * s * c3);
  } else {
    f = {(kappa + 1.5) * s + 0.5 * s3, -(kappa - 1.5) * c - 0.5 * c3};
    df = {0.5 * (kappa + 1.5) * c + 0.75 * c3, 0.5 * (kappa - 1.5) * s + 0.75 * s3};
    field.stress = root * Voigt(-s * (2 + c * c3), s * c * c3, c * (1 - s * s3));
  }
  const Vec2 radial(c2, s2);
  field.displacement = amplitude * f;
  field.gradient =
      amplitude / r * (0.5 * f * radial.transpose() + df * turned_left(radial).transpose());
  return field;
}

}  // namespace cdca
