// SPDX-License-Identifier: BSD-3-Clause
/// Sharing out a graph by METIS. Only the .cpp beside this file knows metis.h.
#pragma once

#include "core/base/communicator.hpp"

#include <vector>

namespace cdca {

/// A part 0..parts-1 for every vertex: parts of about equal weight with few edges between them. The
/// same graph always gives the same answer. Some parts may stay empty, on small graphs. Weights may
/// be left out (all equal). Throws SolveError when the lists of the graph do not fit each other.
std::vector<int> metis_partition(const PartitionGraph& graph, int parts);

}  // namespace cdca
