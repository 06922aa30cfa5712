// SPDX-License-Identifier: BSD-3-Clause
/// Springs between touching faces, as coarse cells see them.
#pragma once

#include "core/cells/face_stiffness.hpp"

#include <vector>

namespace cdca {

using BondStiffness = Eigen::Matrix<double, 16, 16>;

/// What couples a part of one element with a part of another (or of the same): the stiffness over
/// the corners of the first, then those of the second, x and y of each.
struct Bond {
  GridIndex plus, minus;
  int plus_part = 0;
  int minus_part = 0;
  BondStiffness stiffness = BondStiffness::Zero();
};

/// Of all faces with springs, by bilinear functions alone, on the scale of the grid.
std::vector<Bond> finest_bonds(const ElementCuts& cuts, const ElasticMatrix& elastic,
                               const FaceSprings& springs);

/// The entries of a bond for the cells that a rank holds. Functions of the others vanish on a side
/// between two elements.
PartStiffness held_entries(const Bond& bond, const LocalMesh& mesh, const CellUnknowns& unknowns);

}  // namespace cdca
