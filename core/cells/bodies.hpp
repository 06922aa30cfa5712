// SPDX-License-Identifier: BSD-3-Clause
/// Connected bodies of pieces, and whether each of them is held.
#pragma once

#include "core/cells/part_basis.hpp"

namespace cdca {

/// A connected set of pieces of cells.
struct Body {
  Vec2 at{0, 0};  ///< m, a place in it
  std::int64_t pieces = 0;
  bool held = false;  ///< its supports stop all three rigid motions
};

/// All bodies of the grid, the same list on every rank. held: per unknown, as supports prescribe
/// it. Collective.
std::vector<Body> find_bodies(const BasisContext& context, const std::vector<char>& held,
                              Communicator& communicator);

}  // namespace cdca
