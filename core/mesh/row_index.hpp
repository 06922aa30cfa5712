// SPDX-License-Identifier: BSD-3-Clause
/// Finds the local number of a node or an element of a structured grid from its column and row.
#pragma once

#include "core/mesh/grid.hpp"

#include <algorithm>
#include <vector>

namespace cdca {

/// The places (i, j) that a rank holds, as runs of consecutive columns per row; each run has
/// consecutive local numbers. Memory grows with the number of runs, not of places.
class RowIndex {
 public:
  /// Appends the place with the next local number of its kind.
  void add(GridIndex at, LocalId local) { add(at, 1, local); }
  /// Appends `count` places from `at` to the right.
  void add(GridIndex at, int count, LocalId local) {
    if (std::size_t(at.j) >= rows_.size()) rows_.resize(std::size_t(at.j) + 1);
    auto& row = rows_[std::size_t(at.j)];
    if (!row.empty() && row.back().first_i + row.back().count == at.i &&
        row.back().local + row.back().count == local) {
      row.back().count += count;
    } else {
      row.push_back({at.i, count, local});
    }
  }
  /// Call once after the last add().
  void finish() {
    for (auto& row : rows_) {
      std::sort(row.begin(), row.end(),
                [](const Run& a, const Run& b) { return a.first_i < b.first_i; });
    }
  }
  /// The local number, or -1 for a place that this rank does not hold.
  LocalId find(GridIndex at) const {
    if (at.j < 0 || std::size_t(at.j) >= rows_.size()) return -1;
    const auto& row = rows_[std::size_t(at.j)];
    auto run = std::upper_bound(row.begin(), row.end(), at.i,
                                [](int i, const Run& r) { return i < r.first_i; });
    if (run == row.begin()) return -1;
    --run;
    return at.i < run->first_i + run->count ? run->local + (at.i - run->first_i) : -1;
  }

 private:
  struct Run {
    int first_i;
    int count;
    LocalId local;
  };
  std::vector<std::vector<Run>> rows_;
};

}  // namespace cdca
