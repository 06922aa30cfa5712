// SPDX-License-Identifier: BSD-3-Clause
/// The near-tip functions of one cell.
#pragma once

#include "core/cells/near_tip.hpp"
#include "core/mesh/grid.hpp"

namespace cdca {

/// Column k: how much of each F_l - F_l(node) (Eq. 5) the cell's function k takes, m^-1/2. Times
/// N_node these functions are orthonormal: products of their gradients, integrated over the cell's
/// elements as if no crack cut them (4 x 4 points an element), make the unit matrix. Away from the
/// tip those of Eq. 5 are nearly combinations of each other, which tells less the farther it is.
Eigen::Matrix4d orthonormal_tip_functions(const StructuredGrid& grid, GridIndex node,
                                          const TipFrame& frame);

}  // namespace cdca
