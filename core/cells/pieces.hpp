// SPDX-License-Identifier: BSD-3-Clause
/// The pieces of a cell: the connected parts into which cracks cut the support of its node.
#pragma once

#include "core/cells/element_parts.hpp"

#include <array>
#include <vector>

namespace cdca {

/// Which piece of the cell each part of its elements belongs to. Slots are the elements round the
/// node, counter-clockwise from the lower left; outside the grid a slot is empty.
///
/// In the paper's symbols: one crack gives u = v_home and a = +-(v_other - v_home)/2 of Eq. 4; the
/// junction functions of Eq. 21-22 are the cells with three pieces and more.
struct CellPieces {
  int count = 1;
  std::array<std::vector<int>, 4> piece;  ///< [slot][part]

  bool operator==(const CellPieces&) const = default;
};

/// Looks at the whole support: to be asked of the owner of the node only, for a ghost may not see
/// all of it.
CellPieces pieces_of(const ElementParts& elements, GridIndex node);

}  // namespace cdca
