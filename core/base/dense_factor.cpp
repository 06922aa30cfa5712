// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/dense_factor.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <utility>

// Of the interface of BLAS, which any BLAS has. Matrices in order of columns.
extern "C" {
/// C = beta C + alpha A A^T, one triangle of C.
void dsyrk_(const char* triangle, const char* transposed, const int* size, const int* inner,
            const double* alpha, const double* a, const int* a_rows, const double* beta, double* c,
            const int* c_rows);
/// B = alpha B op(A)^-1 for A on the right, alpha op(A)^-1 B for A on the left.
void dtrsm_(const char* side, const char* triangle, const char* transposed, const char* unit,
            const int* rows, const int* columns, const double* alpha, const double* a,
            const int* a_rows, double* b, const int* b_rows);
}

namespace cdca {

bool DenseFactor::compute(Eigen::MatrixXd matrix) {
  constexpr int most = 64;
  constexpr double one = 1.0, minus = -1.0;
  lower_ = std::move(matrix);
  const int size = int(lower_.rows());
  for (int first = 0; first < size; first += most) {
    const int width = std::min(most, size - first), left = size - first - width;
    auto block = lower_.block(first, first, width, width);
    const Eigen::LLT<Eigen::MatrixXd> own(block);
    if (own.info() != Eigen::Success) return false;
    block.triangularView<Eigen::Lower>() = own.matrixL();
    if (left == 0) break;
    double* below = &lower_(first + width, first);
    dtrsm_("R", "L", "T", "N", &left, &width, &one, block.data(), &size, below, &size);
    dsyrk_("L", "N", &left, &width, &minus, below, &size, &one,
           &lower_(first + width, first + width), &size);
  }
  return true;
}

void DenseFactor::solve(Eigen::VectorXd& values) const {
  lower_.triangularView<Eigen::Lower>().solveInPlace(values);
  lower_.triangularView<Eigen::Lower>().transpose().solveInPlace(values);
}

void DenseFactor::solve_columns(Eigen::MatrixXd& columns) const {
  constexpr double one = 1.0;
  const int size = int(columns.rows()), count = int(columns.cols());
  if (size == 0 || count == 0) return;
  for (const char* transposed : {"N", "T"}) {
    dtrsm_("L", "L", transposed, "N", &size, &count, &one, lower_.data(), &size, columns.data(),
           &size);
  }
}

}  // namespace cdca
