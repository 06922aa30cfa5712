// SPDX-License-Identifier: BSD-3-Clause
/// Stress intensity factors by the domain interaction integral.
#pragma once

#include "core/cracks/crack_registry.hpp"
#include "core/mechanics/external_forces.hpp"
#include "core/mechanics/material.hpp"

#include <vector>

namespace cdca {

/// K_I and K_II of one tip, Pa m^1/2. K_II > 0 when sigma_xy > 0 ahead of the tip, in axes with x
/// out of the crack.
struct StressIntensity {
  int crack = 0;
  int end = 0;
  double k1 = 0.0;
  double k2 = 0.0;
  double radius = 0.0;  ///< of the domain, m
};

/// The near-tip field of Williams for K_I = 1 or K_II = 1 (mode 1 or 2) in the axes of the tip.
struct WilliamsField {
  Vec2 displacement;         ///< m per Pa m^1/2
  Eigen::Matrix2d gradient;  ///< of the displacement
  Voigt stress;              ///< per Pa m^1/2
};
WilliamsField williams_field(const Material& material, int mode, double r, double theta);

/// Of every active tip, in the order of the zones; the same on all ranks. Collective.
///
/// M = int (s_ij u'_i,1 + s'_ij u_i,1 - s_ij e'_ij d_1j) q,_j dA - int b_i u'_i,1 q dA
///     - int over faces t_i u'_i,1 q ds,   K = E' M / 2,
/// with the primed near-tip field of one mode; q falls smoothly from 1 to 0 between half the radius
/// and the radius. The domain is kept off the rim, other cracks and bends of the crack itself.
/// state: with ghosts.
std::vector<StressIntensity> stress_intensities(
    const BasisContext& context, const std::vector<Crack>& cracks, const Material& material,
    const ExternalLoads& loads, std::span<const double> state, Communicator& communicator);

}  // namespace cdca
