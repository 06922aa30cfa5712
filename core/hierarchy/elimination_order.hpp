// SPDX-License-Identifier: BSD-3-Clause
/// In which order unknowns are eliminated from a stiffness, so that few entries fill in.
#pragma once

#include <Eigen/SparseCholesky>

#include <vector>

namespace cdca {

/// Rows, columns and values; those of the same place count together.
using StiffnessEntries = std::vector<Eigen::Triplet<double>>;

/// A factor of a stiffness whose unknowns are already in a good order.
using OrderedFactor =
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>;

/// The place of every unknown in such an order (approximate minimum degree). Of every pair of
/// coupled unknowns one entry is enough.
Eigen::VectorXi elimination_order(std::size_t size, const StiffnessEntries& entries);

/// The lower triangle with all unknowns in their places. Every pair of coupled unknowns must have
/// its value once, or once in each triangle if `both` are there.
Eigen::SparseMatrix<double> in_order(const Eigen::VectorXi& place, const StiffnessEntries& entries,
                                     bool both);

}  // namespace cdca
