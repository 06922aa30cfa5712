// SPDX-License-Identifier: BSD-3-Clause
/// The near-tip field of Williams.
#pragma once

#include "core/mechanics/material.hpp"

namespace cdca {

struct WilliamsField {
  Vec2 displacement;         ///< m per Pa m^1/2
  Eigen::Matrix2d gradient;  ///< of the displacement
  Voigt stress;              ///< per Pa m^1/2
};

/// The field for K_I = 1 or K_II = 1 (mode 1 or 2) at r (m) and theta, in the axes of the tip: x
/// out of the crack, y to its left. The angle may go on beyond +-pi.
WilliamsField williams_field(const Material& material, int mode, double r, double theta);

}  // namespace cdca
