// SPDX-License-Identifier: BSD-3-Clause
/// The cut elements of the grid, made when they are first asked for.
#pragma once

#include "core/cells/element_parts.hpp"
#include "core/cracks/crack_paths.hpp"
#include "core/mesh/grid.hpp"

#include <memory>
#include <unordered_map>
#include <vector>

namespace cdca {

/// A straight bit of crack with the parts of elements on its two sides; grid coordinates.
/// Inside an element both elements are the same; along a grid line they differ.
struct CrackFace {
  Vec2 from{0, 0};
  Vec2 to{0, 0};
  int crack = 0;
  int segment = 0;
  GridIndex plus_element;  ///< on the left of from -> to
  GridIndex minus_element;
  int plus_part = 0;
  int minus_part = 0;
  /// Of the crack, grid coordinates; differs from that of the face where this runs round a sliver.
  Vec2 direction{0, 0};
};

class ElementCuts final : public ElementParts {
 public:
  ElementCuts() = default;
  ElementCuts(const StructuredGrid& grid, CrackPaths paths)
      : grid_(grid), paths_(std::move(paths)) {}
  /// Shares the cut elements of `previous` in which the cracks have not changed.
  ElementCuts(const StructuredGrid& grid, CrackPaths paths, const ElementCuts& previous);

  const StructuredGrid& grid() const override { return grid_; }
  const std::vector<GlobalId>& touched_elements() const override { return paths_.touched(); }
  const CrackPaths& paths() const { return paths_; }

  /// The cut element, or null when no crack touches the element: then it has one part, number 0.
  const CutElement* find(GridIndex element) const;
  int parts(GridIndex element) const override;
  const std::vector<SidePortion>& side(GridIndex element, std::size_t side) const override;
  /// The part that holds a place given in grid coordinates inside (or on the rim of) the element.
  int part_at(GridIndex element, const Vec2& at) const;
  /// All parts that reach the place; several on a crack.
  std::vector<int> parts_at(GridIndex element, const Vec2& at) const;

  /// Faces inside the element, and those along its right and upper side.
  std::vector<CrackFace> faces_of(GridIndex element) const;
  /// Faces on which the element lies on one side or both.
  std::vector<CrackFace> faces_at(GridIndex element) const;
  bool touched(GridIndex element) const override { return !paths_.steps_in(element).empty(); }

 private:
  void add_side_faces(GridIndex element, std::vector<CrackFace>& faces) const;

  StructuredGrid grid_;
  CrackPaths paths_;
  mutable std::unordered_map<GlobalId, std::shared_ptr<const CutElement>> cache_;
};

}  // namespace cdca
