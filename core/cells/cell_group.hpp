// SPDX-License-Identifier: BSD-3-Clause
/// A cell with its own stiffness, or all cells of one tip zone, moved together.
#pragma once

#include "core/base/types.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace cdca {

/// K_i^-1 of a cell (2.4.3, step 1). Neighbouring cells with near-tip functions are so strongly
/// coupled that the rule one by one hardly moves them; a zone counts as one cell.
class CellGroup {
 public:
  /// matrix: K_i over `unknowns`; held unknowns have no rows in it.
  CellGroup(LocalId first_node, std::vector<LocalId> unknowns, std::vector<std::size_t> rows,
            const Eigen::SparseMatrix<double>& matrix);

  LocalId first_node() const { return first_node_; }
  /// Free unknowns, and the row of own stiffness of each.
  const std::vector<LocalId>& unknowns() const { return unknowns_; }
  const std::vector<std::size_t>& rows() const { return rows_; }
  /// The move that the forces on the free unknowns cause.
  void solve(const Eigen::VectorXd& forces, Eigen::VectorXd& move) const;

 private:
  using SparseFactor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

  LocalId first_node_;
  std::vector<LocalId> unknowns_;
  std::vector<std::size_t> rows_;
  Eigen::MatrixXd inverse_;               ///< small cells
  std::unique_ptr<SparseFactor> factor_;  ///< large zones
};

}  // namespace cdca
