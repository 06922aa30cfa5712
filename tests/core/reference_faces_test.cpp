// SPDX-License-Identifier: BSD-3-Clause
/// Compliances with softer springs, as the whole stiffness has them.
#include "core/mechanics/reference_faces.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <numeric>

namespace cdca::testing {
namespace {

/// A body of 60 unknowns with springs at 40 places.
struct SpringBody {
  SpringBody() {
    std::srand(6);  // of Eigen's random numbers
    const Eigen::MatrixXd some = Eigen::MatrixXd::Random(60, 60);
    stiffness = some * some.transpose();
    gaps = Eigen::MatrixXd::Random(40, 60);
    springs = Eigen::VectorXd::Constant(40, 50.0) + 40 * Eigen::VectorXd::Random(40);
  }
  /// G (K + G^T s G)^-1 G^T.
  Eigen::MatrixXd compliance(const Eigen::VectorXd& with) const {
    const Eigen::MatrixXd whole = stiffness + gaps.transpose() * with.asDiagonal() * gaps;
    return gaps * whole.inverse() * gaps.transpose();
  }

  Eigen::MatrixXd stiffness, gaps;
  Eigen::VectorXd springs;  ///< of closed faces
};

TEST(ReferenceFaces, ComplyAsTheWholeStiffnessDoes) {
  const SpringBody body;
  const Eigen::MatrixXd closed = body.compliance(body.springs);
  Eigen::VectorXd missing = Eigen::VectorXd::Zero(40);
  for (Eigen::Index k = 0; k < 40; k += 2) missing[k] = k % 3 == 0 ? body.springs[k] : 7.0;
  ReferenceFaces reference;
  EXPECT_FALSE(reference.exists());
  ASSERT_TRUE(reference.refer(closed, missing));
  ASSERT_TRUE(reference.exists());
  const Eigen::MatrixXd wanted = body.compliance(body.springs - missing);
  // some columns first, then others and some again
  for (const std::vector<Eigen::Index>& places :
       {std::vector<Eigen::Index>{3, 8}, std::vector<Eigen::Index>{8, 39, 0, 3, 17}}) {
    const auto at = reference.need(closed, places);
    ASSERT_EQ(at.size(), places.size());
    for (std::size_t k = 0; k < at.size(); ++k) {
      const Eigen::VectorXd off = reference.columns().col(at[k]) - wanted.col(places[k]);
      EXPECT_LT(off.norm(), 1e-11 * wanted.norm()) << places[k];
    }
  }
  const Eigen::VectorXd some = Eigen::VectorXd::LinSpaced(40, -2, 3);
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(40, 40) - closed * missing.asDiagonal();
  const Eigen::VectorXd off = left * reference.moved(some) - some;
  EXPECT_LT(off.norm(), 1e-11 * some.norm());
}

TEST(ReferenceFaces, SayWhereSpringsDoNotHoldTheBody) {
  const SpringBody body;
  const Eigen::MatrixXd closed = body.compliance(body.springs);
  ReferenceFaces reference;
  EXPECT_FALSE(reference.refer(closed, 1e6 * body.springs)) << "springs less than none";
  EXPECT_FALSE(reference.exists());
}

}  // namespace
}  // namespace cdca::testing
