// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/node_runs.hpp"

namespace cdca {

std::vector<NodeRun> runs_without(std::span<const NodeRun> runs, std::span<const LocalId> others) {
  std::vector<NodeRun> left;
  auto other = others.begin();
  for (const NodeRun& run : runs) {
    while (other != others.end() && *other < run.first) ++other;
    LocalId from = run.first;
    const auto close = [&](LocalId to) {
      if (from < to) left.push_back({from, to - from, {run.at.i + from - run.first, run.at.j}});
    };
    for (; other != others.end() && *other < run.end(); ++other) {
      close(*other);
      from = *other + 1;
    }
    close(run.end());
  }
  return left;
}

std::vector<LocalId> nodes_between(std::span<const NodeRun> runs, LocalId end) {
  std::vector<LocalId> nodes;
  LocalId next = 0;
  const auto list_to = [&](LocalId stop) {
    for (; next < stop; ++next) nodes.push_back(next);
  };
  for (const NodeRun& run : runs) {
    list_to(run.first);
    next = run.end();
  }
  list_to(end);
  return nodes;
}

}  // namespace cdca
