// SPDX-License-Identifier: BSD-3-Clause
/// How loose bodies have moved as a whole.
#pragma once

#include "core/cells/bodies.hpp"

#include <span>
#include <vector>

namespace cdca {

/// Displacements (m, with ghosts) less the translation and the rotation, linear in its angle, that
/// come nearest to those of each body which supports do not hold. Stresses are the same; what is
/// integrated no longer has to cancel a long way. Collective.
std::vector<double> without_rigid_motions(const BasisContext& context, const Bodies& bodies,
                                          std::span<const double> displacements,
                                          Communicator& communicator);

}  // namespace cdca
