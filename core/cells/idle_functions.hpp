// SPDX-License-Identifier: BSD-3-Clause
/// Near-tip functions that strain nothing.
#pragma once

#include "core/base/communicator.hpp"
#include "core/cells/cell_unknowns.hpp"
#include "core/cells/stiffness_rows.hpp"

#include <vector>

namespace cdca {

/// What is added to a value of the rows, Pa.
struct AddedStiffness {
  std::size_t place = 0;
  double value = 0.0;
};

/// Combinations of near-tip functions that strain nothing, as where these act on a small corner
/// only, are held at 0: of one cell, and of all cells of a zone of one element, whichever ranks
/// have them. rows: without springs of faces, since faces that turn must not change what is held.
/// Collective.
std::vector<AddedStiffness> holds_of_idle_functions(const LocalMesh& mesh,
                                                    const CellUnknowns& unknowns,
                                                    const StiffnessRows& rows,
                                                    Communicator& communicator);

}  // namespace cdca
