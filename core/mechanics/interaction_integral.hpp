// SPDX-License-Identifier: BSD-3-Clause
/// Stress intensity factors by the domain interaction integral.
#pragma once

#include "core/cracks/crack_registry.hpp"
#include "core/mechanics/external_forces.hpp"
#include "core/mechanics/intensity_weights.hpp"
#include "core/mechanics/material.hpp"

#include <functional>
#include <vector>

namespace cdca {

/// K_I and K_II of one tip, Pa m^1/2. K_II > 0 when sigma_xy > 0 ahead of the tip, in axes with x
/// out of the crack.
struct StressIntensity {
  int crack = 0;
  int end = 0;
  double k1 = 0.0;
  double k2 = 0.0;
  double radius = 0.0;     ///< of the domain, m
  bool k1_fitted = false;  ///< K_I from the gap at the tip
};

/// How far the domain reaches from the tip, in element sizes: as far as wanted, less where a rim,
/// another crack or a bend of the crack itself comes nearer, but never less than the smallest.
struct DomainReach {
  double wanted = 5.0;
  double smallest = 4.0;
};

/// Which tips are asked for; empty: all.
using TipChoice = std::function<bool(int crack, int end)>;

/// Of every active tip, in the order of the zones; the same on all ranks. Collective.
///
/// With P_j = s_ij u'_i,1 + s'_ij u_i,1 - s_ik e'_ik d_1j, the primed near-tip field of one mode,
/// and q falling from 1 to 0 between half the radius and the radius, bilinear in every element,
///
///     M = int P_j q,_j dA - int b_i u'_i,1 q dA - int P_j m_j q ds,   K = E' M / 2.
///
/// The last integral is over all faces and rims inside the domain, m out of the material and
/// s_ij m_j = t_i the traction there; on the straight faces behind the tip only t_i u'_i,1 is left
/// of it. The primed field is continued up to the faces of a bent crack, so the formula is exact
/// with bends, other cracks and rims inside the domain.
///
/// Where faces touch at the tip itself, their normal traction there is known to some percent only,
/// and the integral weighs it with 1 / sqrt(r): K_I is fitted to the gap instead, and is all but 0:
/// to that of the faces between the bodies that end at the tip, at most two elements.
/// state: with ghosts. cache: of the same body, material and grid; what the displacements count for
/// is found there where cracks and tips are as before.
std::vector<StressIntensity> stress_intensities(
    const BasisContext& context, const std::vector<Crack>& cracks, const Material& material,
    const ExternalLoads& loads, std::span<const double> state, Communicator& communicator,
    IntensityCache& cache, const TipChoice& wanted = {}, const DomainReach& reach = {});

}  // namespace cdca
