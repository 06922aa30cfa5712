// SPDX-License-Identifier: BSD-3-Clause
/// Nodes that stand side by side, row by row: most cells need no look at each of them.
#pragma once

#include "core/mesh/grid.hpp"

#include <span>
#include <vector>

namespace cdca {

/// Neighbours in a grid row whose local numbers are consecutive.
struct NodeRun {
  LocalId first = 0;
  LocalId count = 0;
  GridIndex at;  ///< the first of them
  LocalId end() const { return first + count; }
  int end_column() const { return at.i + count; }
};

/// The runs that are left without some nodes. runs, others: ascending.
std::vector<NodeRun> runs_without(std::span<const NodeRun> runs, std::span<const LocalId> others);

/// The nodes in [0, end) that are in none of the runs, ascending.
std::vector<LocalId> nodes_between(std::span<const NodeRun> runs, LocalId end);

}  // namespace cdca
