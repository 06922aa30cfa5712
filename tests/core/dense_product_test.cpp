// SPDX-License-Identifier: BSD-3-Clause
/// Products are what Eigen finds, of any size, of parts of larger matrices too.
#include "core/base/dense_product.hpp"

#include <gtest/gtest.h>

namespace cdca::testing {
namespace {

/// A part of a larger matrix, so that its columns lie apart.
struct Part {
  Part(Eigen::Index rows, Eigen::Index columns)
      : whole(Eigen::MatrixXd::Random(rows + 3, columns + 2)) {}
  auto block() { return whole.block(2, 1, whole.rows() - 3, whole.cols() - 2); }

  Eigen::MatrixXd whole;
};

struct Sizes {
  Eigen::Index rows, columns, inner;
};

TEST(DenseProduct, AddsToAPart) {
  std::srand(4);  // of Eigen's random numbers
  for (const auto& [rows, columns, inner] :
       {Sizes{3, 2, 5}, Sizes{0, 4, 3}, Sizes{40, 7, 33}, Sizes{20, 130, 64}, Sizes{9, 9, 0}}) {
    for (const Transposed which : {Transposed::neither, Transposed::first, Transposed::second}) {
      Part a(which == Transposed::first ? inner : rows, which == Transposed::first ? rows : inner);
      Part b(which == Transposed::second ? columns : inner,
             which == Transposed::second ? inner : columns);
      Part sum(rows, columns);
      Eigen::MatrixXd wanted = sum.whole;
      const Eigen::MatrixXd first = which == Transposed::first
                                        ? Eigen::MatrixXd(a.block().transpose())
                                        : Eigen::MatrixXd(a.block());
      const Eigen::MatrixXd second = which == Transposed::second
                                         ? Eigen::MatrixXd(b.block().transpose())
                                         : Eigen::MatrixXd(b.block());
      wanted.block(2, 1, rows, columns) += 1.5 * first * second;
      add_product(1.5, a.block(), b.block(), which, sum.block());
      EXPECT_LT((sum.whole - wanted).norm(), 1e-13 * (1 + wanted.norm())) << rows << " " << columns;
    }
  }
}

TEST(DenseProduct, AddsToALowerTriangle) {
  std::srand(4);
  for (const Eigen::Index size : {1, 5, 95, 96, 97, 230}) {
    for (const Transposed which : {Transposed::neither, Transposed::first, Transposed::second}) {
      const Eigen::Index inner = 20;
      Part a(which == Transposed::first ? inner : size, which == Transposed::first ? size : inner);
      Part b(which == Transposed::second ? size : inner,
             which == Transposed::second ? inner : size);
      Part sum(size, size);
      Part wanted = sum;
      add_product(-0.5, a.block(), b.block(), which, wanted.block());
      add_lower_product(-0.5, a.block(), b.block(), which, sum.block());
      const Eigen::MatrixXd off = sum.block() - wanted.block();
      EXPECT_LT(Eigen::MatrixXd(off.triangularView<Eigen::Lower>()).norm(), 1e-12 * double(size));
    }
  }
}

}  // namespace
}  // namespace cdca::testing
