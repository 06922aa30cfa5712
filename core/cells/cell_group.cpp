// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/cell_group.hpp"

#include "core/base/errors.hpp"

namespace cdca {

namespace {
constexpr Eigen::Index largest_dense = 200;
}

CellGroup::CellGroup(LocalId first_node, std::vector<LocalId> unknowns,
                     std::vector<std::size_t> rows, const Eigen::SparseMatrix<double>& matrix)
    : first_node_(first_node), unknowns_(std::move(unknowns)), rows_(std::move(rows)) {
  if (matrix.rows() <= largest_dense) {
    const Eigen::MatrixXd dense(matrix);
    inverse_ = dense.ldlt().solve(Eigen::MatrixXd::Identity(dense.rows(), dense.cols()));
    // CG needs a symmetric preconditioner, to the last bit
    inverse_ = 0.5 * (inverse_ + inverse_.transpose()).eval();
    return;
  }
  factor_ = std::make_unique<SparseFactor>(matrix);
  if (factor_->info() != Eigen::Success) {
    throw SolveError("the stiffness of a tip zone could not be factored");
  }
}

void CellGroup::solve(const Eigen::VectorXd& forces, Eigen::VectorXd& move) const {
  if (factor_) {
    move = factor_->solve(forces);
  } else {
    move.noalias() = inverse_ * forces;
  }
}

}  // namespace cdca
