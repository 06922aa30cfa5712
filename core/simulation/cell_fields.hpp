// SPDX-License-Identifier: BSD-3-Clause
/// Fields of the cells that do not depend on how the cells are shared out among ranks.
#pragma once

#include "core/base/communicator.hpp"
#include "core/cells/part_basis.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cdca {

/// A row per cell: the values of its unknowns in the cell's own order (pieces, then near-tip).
struct CellFields {
  std::vector<std::int64_t> nodes;   ///< global id of the cell of every row
  std::vector<std::int64_t> counts;  ///< its number of unknowns
  std::vector<double> displacement;  ///< counts[k] values for row k, m
  std::vector<double> force;         ///< likewise: of loads and supports, N per metre of thickness
};

/// The rows of this rank's own cells. A field that is empty counts as zero.
CellFields fields_of_cells(const BasisContext& basis, std::span<const double> displacement,
                           std::span<const double> force);

/// Sends every row to the rank that owns its cell, whichever rank has read it. Collective.
CellFields rows_for_owners(const CellFields& rows, const LocalMesh& mesh,
                           Communicator& communicator);

/// Puts rows of own cells into vectors of all unknowns. Throws IoError on all ranks when they are
/// not the rows of exactly these cells with these unknowns. Collective.
void put_cells(const CellFields& rows, const BasisContext& basis, Communicator& communicator,
               std::span<double> displacement, std::span<double> force);

}  // namespace cdca
