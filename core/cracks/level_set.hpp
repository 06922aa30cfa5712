// SPDX-License-Identifier: BSD-3-Clause
/// The level sets of a crack (Eq. 1-3 of the paper) and the typing of cells by them.
#pragma once

#include "core/cracks/crack.hpp"
#include "core/mesh/block_partition.hpp"
#include "core/mesh/grid.hpp"

#include <vector>

namespace cdca {

/// Level sets of one crack; nothing is stored but a reference to it.
class LevelSet {
 public:
  explicit LevelSet(const Crack& crack) : crack_(&crack) {}

  /// Eq. 1: signed distance to the crack, m; positive on the left of its direction.
  double distance(const Vec2& x) const;
  /// Eq. 3: the second level set, orthogonal to the first: how far x lies beyond the end, m;
  /// negative beside the crack.
  double beyond_end(const Vec2& x, int end) const;

 private:
  const Crack* crack_;
};

enum class CellKind { continuous, cut, tip };

/// Type of an element from the level sets at its four nodes (2.4.2): cut when the distance changes
/// sign beside the crack, tip when it does so across an active end, as straight lines between the
/// nodes have it (Eq. 2).
CellKind kind_of_element(const StructuredGrid& grid, const LevelSet& level_set, const Crack& crack,
                         GridIndex element);

/// Elements within `margin` elements of the crack: the narrow band.
std::vector<GridIndex> narrow_band(const StructuredGrid& grid, const Crack& crack, int margin);

/// What cracks add to the unknowns of their cells, estimated from the level sets: the weights of
/// the partition. tip_radius in m.
std::vector<CellWeight> cell_weights(const StructuredGrid& grid, const std::vector<Crack>& cracks,
                                     double tip_radius);

}  // namespace cdca
