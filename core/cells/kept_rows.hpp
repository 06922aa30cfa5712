// SPDX-License-Identifier: BSD-3-Clause
/// Rows of own stiffness that are what they were.
#pragma once

#include "core/cells/carried_cells.hpp"

#include <vector>

namespace cdca {

class KeptRows {
 public:
  /// carried: null for none. count: of the unknowns now.
  KeptRows(const CarriedCells* carried, std::size_t count);

  /// Keeps the rows of all these unknowns of a cell, if the cell is the same and had rows before.
  bool keep(LocalId node, const std::vector<LocalId>& unknowns);
  /// The rows kept, under their new numbers and without springs, and those made anew.
  StiffnessRows with(StiffnessRows made) const;

 private:
  const CarriedCells* carried_;
  std::vector<std::ptrdiff_t> row_of_;  ///< of an unknown now: its row before
  std::vector<char> kept_;              ///< by row before
};

}  // namespace cdca
