// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/dense_product.hpp"

#include <algorithm>

// Of the interface of BLAS. Matrices in order of columns.
extern "C" {
/// C = beta C + alpha op(A) op(B).
void dgemm_(const char* transposed_a, const char* transposed_b, const int* rows, const int* columns,
            const int* inner, const double* alpha, const double* a, const int* a_rows,
            const double* b, const int* b_rows, const double* beta, double* c, const int* c_rows);
}

namespace cdca {

namespace {

/// Fewer products than these cost less without a call.
constexpr Eigen::Index few = 16 * 16 * 16;

Eigen::Index inner_size(const DenseBlock& a, Transposed which) {
  return which == Transposed::first ? a.rows() : a.cols();
}

}  // namespace

void add_product(double factor, const DenseBlock& a, const DenseBlock& b, Transposed which,
                 DenseSum sum) {
  if (sum.rows() * sum.cols() * inner_size(a, which) < few) {
    if (which == Transposed::neither) sum += factor * a.lazyProduct(b);
    if (which == Transposed::first) sum += factor * a.transpose().lazyProduct(b);
    if (which == Transposed::second) sum += factor * a.lazyProduct(b.transpose());
    return;
  }
  constexpr double one = 1.0;
  const int rows = int(sum.rows()), columns = int(sum.cols()), inner = int(inner_size(a, which));
  const int a_rows = int(a.outerStride()), b_rows = int(b.outerStride());
  const int sum_rows = int(sum.outerStride());
  dgemm_(which == Transposed::first ? "T" : "N", which == Transposed::second ? "T" : "N", &rows,
         &columns, &inner, &factor, a.data(), &a_rows, b.data(), &b_rows, &one, sum.data(),
         &sum_rows);
}

void add_lower_product(double factor, const DenseBlock& a, const DenseBlock& b, Transposed which,
                       DenseSum sum) {
  constexpr Eigen::Index widest = 96;
  const Eigen::Index size = sum.rows();
  for (Eigen::Index first = 0; first < size; first += widest) {
    const Eigen::Index width = std::min(widest, size - first), left = size - first;
    const DenseBlock rows = which == Transposed::first ? DenseBlock(a.middleCols(first, left))
                                                       : DenseBlock(a.middleRows(first, left));
    const DenseBlock columns = which == Transposed::second ? DenseBlock(b.middleRows(first, width))
                                                           : DenseBlock(b.middleCols(first, width));
    add_product(factor, rows, columns, which, sum.block(first, first, left, width));
  }
}

}  // namespace cdca
