// SPDX-License-Identifier: BSD-3-Clause
/// How cracks divide the elements of a grid: what the pieces of cells are made from, on every
/// scale.
#pragma once

#include "core/cells/cut_element.hpp"
#include "core/mesh/grid.hpp"

#include <vector>

namespace cdca {

class ElementParts {
 public:
  virtual ~ElementParts() = default;

  virtual const StructuredGrid& grid() const = 0;
  /// Elements that cracks touch, in order of id. An element not listed has one part, number 0.
  virtual const std::vector<GlobalId>& touched_elements() const = 0;
  virtual bool touched(GridIndex element) const = 0;
  virtual int parts(GridIndex element) const = 0;
  /// The portions of one side, whether the element is cut or not.
  virtual const std::vector<SidePortion>& side(GridIndex element, std::size_t side) const = 0;
};

}  // namespace cdca
