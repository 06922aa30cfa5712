// SPDX-License-Identifier: BSD-3-Clause
/// L L^T of matrices that are large and dense, at the speed of the machine at hand.
#pragma once

#include <Eigen/Core>

namespace cdca {

/// BLIS finds out what the processor can do where the program runs; Eigen has to know when it is
/// compiled.
class DenseFactor {
 public:
  /// Only the lower triangle counts. Returns whether the matrix is positive definite.
  bool compute(Eigen::MatrixXd matrix);
  /// values = matrix^-1 values.
  void solve(Eigen::VectorXd& values) const;
  /// The same for all columns.
  void solve_columns(Eigen::MatrixXd& columns) const;

 private:
  Eigen::MatrixXd lower_;
};

}  // namespace cdca
