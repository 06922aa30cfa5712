// SPDX-License-Identifier: BSD-3-Clause
/// Displacements from one set of cracks to the next.
#pragma once

#include "core/cells/part_basis.hpp"

namespace cdca {

/// Gives every piece of an own cell the displacement of the old piece at the same place, and tips
/// that have hardly moved the fields that they had; ghosts are at 0. So the gaps of faces stay what
/// they were, but for the fields of tips that have moved on and of modes that a cell no longer has:
/// friction goes on from there.
std::vector<double> carried_state(const BasisContext& before, std::vector<double> old_state,
                                  const BasisContext& after);

}  // namespace cdca
