// SPDX-License-Identifier: BSD-3-Clause
/// The cracks as the cells see them: chopped by the grid lines into steps that stay in one element.
#pragma once

#include "core/cracks/crack.hpp"
#include "core/mesh/grid.hpp"

#include <unordered_map>
#include <vector>

namespace cdca {

/// A straight bit of a crack inside one element, or along one element edge; grid coordinates.
struct PathStep {
  Vec2 from{0, 0};
  Vec2 to{0, 0};
  int crack = 0;
  int segment = 0;   ///< of the crack's polyline
  Vec2 along{0, 0};  ///< the whole segment: the direction of a short bit is not exact
};

/// A tip, or the place where one was before growth joined it, in grid coordinates.
struct PathTip {
  int crack = 0;
  int end = 0;
  Vec2 at{0, 0};
  bool is_active = true;
};

/// All cracks laid over the grid.
///
/// Points of cracks nearer to a grid line than `snap` element sizes are moved onto it, and a path
/// that passes a node nearer than that runs through the node. So a crack either misses a node
/// clearly or meets it exactly, and each place is judged alike from all elements round it. Cracks
/// that cross or touch share a point there.
class CrackPaths {
 public:
  static constexpr double snap = 1e-6;

  CrackPaths() = default;
  CrackPaths(const StructuredGrid& grid, const std::vector<Crack>& cracks);

  const std::vector<PathStep>& steps() const { return steps_; }
  /// The steps inside an element or along its edges; empty for most elements.
  const std::vector<int>& steps_in(GridIndex element) const;
  /// Elements with steps, in order of id.
  const std::vector<GlobalId>& touched() const { return touched_; }
  const PathStep& step_in(GridIndex element, int index) const {
    return steps_[std::size_t(steps_in(element)[std::size_t(index)])];
  }
  /// Do the cracks run through the element as those of `other`?
  bool same_steps(const CrackPaths& other, GridIndex element) const;
  const std::vector<PathTip>& tips() const { return tips_; }

 private:
  void add_step(PathStep step);

  StructuredGrid grid_;
  std::vector<PathStep> steps_;
  std::unordered_map<GlobalId, std::vector<int>> by_element_;
  std::vector<GlobalId> touched_;
  std::vector<PathTip> tips_;
};

}  // namespace cdca
