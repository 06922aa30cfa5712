// SPDX-License-Identifier: BSD-3-Clause
/// Displacements from one set of cracks to the next.
#pragma once

#include "core/cells/part_basis.hpp"

namespace cdca {

/// Gives every piece of an own cell the displacement of the old piece at the same place, and tips
/// that have hardly moved their old coefficients. A start value only: any state would do.
void carry_state(const BasisContext& before, std::span<const double> old_state,
                 const BasisContext& after, std::span<double> state);

}  // namespace cdca
