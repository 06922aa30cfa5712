// SPDX-License-Identifier: BSD-3-Clause
/// Near-tip functions that strain nothing.
#pragma once

#include "core/cells/cell_unknowns.hpp"
#include "core/cells/stiffness_rows.hpp"

namespace cdca {

/// Combinations of near-tip functions that strain nothing, as where these act on a small corner
/// only, are held at 0: of one cell, and of all cells of a zone of one element. Adds to the rows,
/// which count no springs of faces: faces that turn must not change what is held. Cells without
/// rows stay as they are.
void hold_idle_functions(const LocalMesh& mesh, const CellUnknowns& unknowns, StiffnessRows& rows);

}  // namespace cdca
