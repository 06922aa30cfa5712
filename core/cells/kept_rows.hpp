// SPDX-License-Identifier: BSD-3-Clause
/// Rows of own stiffness that are what they were.
#pragma once

#include "core/cells/carried_cells.hpp"

#include <vector>

namespace cdca {

class KeptRows {
 public:
  /// carried: null for none.
  explicit KeptRows(const CarriedCells* carried);

  /// Keeps the rows of all these unknowns of a cell, if the cell is the same and had rows before.
  bool keep(LocalId node, const std::vector<LocalId>& unknowns);
  /// The rows kept, under their new numbers and without springs, and those made anew.
  StiffnessRows with(StiffnessRows made) const;

 private:
  const CarriedCells* carried_;
  std::vector<LocalId> now_;  ///< ascending: unknowns whose cells have the unknowns that they had,
  std::vector<std::size_t> row_;  ///< and the row before of each of them
  std::vector<char> kept_;        ///< by row before
  std::vector<std::size_t> rows_of_cell_;
  std::size_t next_ = 0;  ///< of now_: what will probably be asked for next
};

}  // namespace cdca
