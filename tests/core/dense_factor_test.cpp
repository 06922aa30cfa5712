// SPDX-License-Identifier: BSD-3-Clause
/// Factors block by block, of any size.
#include "core/base/dense_factor.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace cdca::testing {
namespace {

Eigen::MatrixXd positive(Eigen::Index size) {
  std::srand(5);  // of Eigen's random numbers
  const Eigen::MatrixXd some = Eigen::MatrixXd::Random(size, size);
  Eigen::MatrixXd matrix = some * some.transpose();
  matrix.diagonal().array() += 1.0;
  return matrix;
}

TEST(DenseFactor, Solves) {
  for (const Eigen::Index size : {0, 1, 5, 63, 64, 65, 128, 200}) {
    const Eigen::MatrixXd matrix = positive(size);
    const Eigen::VectorXd wanted = Eigen::VectorXd::LinSpaced(size, -1, 2);
    // what is above the diagonal does not count
    Eigen::MatrixXd lower = matrix;
    lower.triangularView<Eigen::StrictlyUpper>().setConstant(7.0);
    DenseFactor factor;
    ASSERT_TRUE(factor.compute(lower));
    Eigen::VectorXd found = matrix * wanted;
    factor.solve(found);
    EXPECT_LE((found - wanted).norm(), 1e-10 * wanted.norm()) << size;
  }
}

TEST(DenseFactor, SolvesColumns) {
  for (const Eigen::Index size : {1, 64, 150}) {
    const Eigen::MatrixXd matrix = positive(size), wanted = Eigen::MatrixXd::Random(size, 7);
    DenseFactor factor;
    ASSERT_TRUE(factor.compute(matrix));
    Eigen::MatrixXd found = matrix * wanted;
    factor.solve_columns(found);
    EXPECT_LT((found - wanted).norm(), 1e-10 * wanted.norm()) << size;
  }
}

TEST(DenseFactor, SaysWhereThereIsNone) {
  for (const Eigen::Index at : {0, 70, 149}) {
    Eigen::MatrixXd matrix = positive(150);
    matrix(at, at) = -1.0;
    EXPECT_FALSE(DenseFactor().compute(matrix)) << at;
  }
}

}  // namespace
}  // namespace cdca::testing
