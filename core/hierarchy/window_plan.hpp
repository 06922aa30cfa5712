// SPDX-License-Identifier: BSD-3-Clause
/// Where the cells near cracks are solved for together.
#pragma once

#include "core/cells/element_parts.hpp"
#include "core/cells/tip_zone.hpp"

#include <vector>

namespace cdca {

/// A set of cells that are brought into equilibrium at once. Windows of one colour do not touch.
struct WindowPlan {
  int colour = 0;
  std::vector<GlobalId> nodes;  ///< ascending
};

/// The windows of a scale, the same on every rank.
struct WindowPlans {
  std::vector<WindowPlan> windows;
  int colours = 0;
  /// Cells with a cut element or near-tip functions, ascending: windows alone move them.
  std::vector<GlobalId> near_cracks;
};

/// Sizes in elements; any will do (docs/solver.md tells why).
struct WindowShape {
  int tile = 8;     ///< the grid is divided into squares of so many nodes
  int overlap = 2;  ///< by which a window reaches into the squares next to its own
  int reach = 2;    ///< from the cells near cracks to the farthest cell of their window
};

/// One window for every square with cells near cracks, as wide as it reaches along them, and one
/// for every tip zone that is wider than three cells.
WindowPlans plan_windows(const ElementParts& elements, const std::vector<TipZone>& zones,
                         const WindowShape& shape = {});

}  // namespace cdca
