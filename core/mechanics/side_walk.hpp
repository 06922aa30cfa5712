// SPDX-License-Identifier: BSD-3-Clause
/// The elements along one side of the body.
#pragma once

#include "core/mechanics/boundary_spec.hpp"
#include "core/mesh/local_mesh.hpp"

#include <vector>

namespace cdca {

/// How an element lies at a side of the body.
struct SideGeometry {
  std::size_t element_side;  ///< 0 bottom, 1 right, 2 top, 3 left
  std::size_t first_corner;  ///< corner at t = 0
  std::size_t last_corner;   ///< corner at t = 1
  Vec2 outward;

  /// Place inside the element at fraction t of the side.
  Vec2 at(double t) const;
};

SideGeometry geometry_of(Side side);

/// The sides of the body at which an element lies.
std::vector<Side> sides_at(const StructuredGrid& grid, GridIndex element);

/// This rank's elements at the side.
std::vector<GridIndex> elements_at(const LocalMesh& mesh, Side side);

}  // namespace cdca
