// SPDX-License-Identifier: BSD-3-Clause
/// What observers are shown of the fields and of the cracks.
#pragma once

#include "core/simulation/model.hpp"
#include "core/simulation/snapshot.hpp"

namespace cdca {

/// Every element of the grid once, on the rank that evaluates it; cut elements and those of tip
/// zones as separate polygons.
FieldPart draw_fields(const Model& model);

/// The crack faces of this rank's elements, with the jump across them.
CrackPart draw_cracks(const Model& model);

}  // namespace cdca
