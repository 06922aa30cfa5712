// SPDX-License-Identifier: BSD-3-Clause
/// Stiffness of one part of one element (Eq. 14).
#pragma once

#include "core/cells/part_basis.hpp"

namespace cdca {

/// Stress from strain, for (xx, yy, 2 xy); Pa.
using ElasticMatrix = Eigen::Matrix3d;

/// A dense symmetric matrix over the unknowns listed with it, N/m per metre of thickness.
struct PartStiffness {
  std::vector<LocalId> unknowns;
  Eigen::MatrixXd matrix;
};

/// K = int B^T D B over the part.
PartStiffness part_stiffness(const BasisContext& context, GridIndex element, int part,
                             const ElasticMatrix& elastic);

/// Of an element without cracks; nodes counter-clockwise from the lower left, x and y of each.
Eigen::Matrix<double, 8, 8> plain_stiffness(const Vec2& h, const ElasticMatrix& elastic);

}  // namespace cdca
