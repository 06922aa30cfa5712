// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/metis_partition.hpp"

#include "core/base/errors.hpp"

#include <metis.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

namespace cdca {
namespace {

void check(const PartitionGraph& graph, int parts) {
  const auto edges = static_cast<std::int64_t>(graph.neighbours.size());
  if (parts < 1)
    throw SolveError("A graph cannot be shared out among " + std::to_string(parts) + " parts.");
  if (graph.offsets.empty() || graph.offsets.front() != 0 || graph.offsets.back() != edges ||
      !std::is_sorted(graph.offsets.begin(), graph.offsets.end()))
    throw SolveError("The offsets of the partition graph do not fit its neighbour lists.");
  const auto vertices = graph.offsets.size() - 1;
  if (!graph.weights.empty() && graph.weights.size() != vertices)
    throw SolveError("The partition graph has " + std::to_string(vertices) + " vertices but " +
                     std::to_string(graph.weights.size()) + " weights.");
  if (edges > std::numeric_limits<idx_t>::max())
    throw SolveError("The partition graph is too large for METIS: coarsen it first.");
  const auto outside = [&](std::int32_t v) {
    return v < 0 || static_cast<std::size_t>(v) >= vertices;
  };
  if (std::any_of(graph.neighbours.begin(), graph.neighbours.end(), outside))
    throw SolveError("The partition graph names a neighbour that it does not have.");
}

/// METIS adds weights in 32 bits and divides by their sum: keep the sum small and not zero.
std::vector<idx_t> safe_weights(const PartitionGraph& graph) {
  const auto vertices = graph.offsets.size() - 1;
  std::vector<idx_t> weights(graph.weights.begin(), graph.weights.end());
  for (idx_t& weight : weights) weight = std::max<idx_t>(weight, 0);
  const auto total = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
  if (total == 0) return std::vector<idx_t>(vertices, 1);
  const std::int64_t divisor = total / (std::numeric_limits<idx_t>::max() / 4) + 1;
  for (idx_t& weight : weights) weight = static_cast<idx_t>((weight + divisor - 1) / divisor);
  return weights;
}

}  // namespace

std::vector<int> metis_partition(const PartitionGraph& graph, int parts) {
  check(graph, parts);
  const auto vertices = graph.offsets.size() - 1;
  std::vector<int> part(vertices, 0);
  if (parts == 1 || vertices == 0) return part;  // METIS divides by zero on one part
  if (vertices <= static_cast<std::size_t>(parts)) {
    std::iota(part.begin(), part.end(), 0);
    return part;
  }
  std::vector<idx_t> offsets(graph.offsets.begin(), graph.offsets.end());
  std::vector<idx_t> neighbours(graph.neighbours.begin(), graph.neighbours.end());
  std::vector<idx_t> weights = safe_weights(graph);
  std::vector<idx_t> result(vertices, 0);
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_NCUTS] = 4;  // the best of four: shorter borders for every later message
  idx_t count = static_cast<idx_t>(vertices);
  idx_t constraints = 1;
  idx_t wanted = parts;
  idx_t cut = 0;
  // Recursive bisection keeps a tighter balance where parts are few; k-way is faster for many.
  auto* const method = parts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status =
      method(&count, &constraints, offsets.data(), neighbours.data(), weights.data(), nullptr,
             nullptr, &wanted, nullptr, nullptr, options, &cut, result.data());
  if (status != METIS_OK)
    throw SolveError("METIS could not share out a graph of " + std::to_string(vertices) +
                     " vertices among " + std::to_string(parts) + " parts.");
  std::copy(result.begin(), result.end(), part.begin());
  return part;
}

}  // namespace cdca
