// SPDX-License-Identifier: BSD-3-Clause
/// Factors made of dense fronts solve as dense ones do, and make anew only what has changed.
#include "core/hierarchy/front_factor.hpp"

#include "core/hierarchy/coarsest_factor.hpp"
#include "core/hierarchy/elimination_order.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace cdca::testing {
namespace {

/// A grid of springs with two unknowns a node, and a few nodes of many unknowns, as those of tips.
class Springs {
 public:
  explicit Springs(int nodes) : nodes_(nodes), size_(2 * nodes * nodes + 3 * many) {
    for (int j = 0; j < nodes; ++j) {
      for (int i = 0; i < nodes; ++i) {
        for (int k = 0; k < 2; ++k) {
          const int u = unknown(i, j, k);
          entries_.emplace_back(u, u, 0.01 + value());
          if (i > 0) couple(u, unknown(i - 1, j, 0));
          if (j > 0) couple(u, unknown(i, j - 1, k));
        }
        couple(unknown(i, j, 0), unknown(i, j, 1));
      }
    }
    for (int tip = 0; tip < 3; ++tip) {
      for (int a = 0; a < many; ++a) {
        const int u = 2 * nodes * nodes + many * tip + a;
        entries_.emplace_back(u, u, 0.01 + value());
        for (int b = 0; b < a; ++b) couple(u, u - a + b);
        couple(u, unknown(2 * tip, 3 * tip, a % 2));
      }
    }
    place_ = elimination_order(std::size_t(size_), entries_);
  }
  Eigen::SparseMatrix<double> lower() const { return in_order(place_, entries_, false); }
  const StiffnessEntries& entries() const { return entries_; }
  int size() const { return size_; }
  int place_of(int i, int j) const { return place_[unknown(i, j, 0)]; }

 private:
  static constexpr int many = 20;

  int unknown(int i, int j, int k) const { return 2 * (j * nodes_ + i) + k; }
  double value() { return std::uniform_real_distribution<>(0.1, 1.0)(engine_); }
  void couple(int a, int b) {
    const double spring = value();
    entries_.emplace_back(a, a, spring);
    entries_.emplace_back(b, b, spring);
    entries_.emplace_back(std::max(a, b), std::min(a, b), -spring);
  }

  int nodes_, size_;
  std::mt19937 engine_{7};
  StiffnessEntries entries_;
  Eigen::VectorXi place_;
};

Eigen::VectorXd solved(const FrontFactor& factor, const Eigen::VectorXd& forces) {
  Eigen::VectorXd moves = forces;
  factor.solve(moves);
  return moves;
}

TEST(FrontFactor, SolvesAsADenseFactorDoes) {
  for (const int nodes : {6, 9, 17}) {
    const Springs springs(nodes);
    const auto lower = springs.lower();
    FrontFactor factor;
    factor.lay_fronts(lower);
    ASSERT_TRUE(factor.factorize(lower));
    const Eigen::VectorXd forces = Eigen::VectorXd::LinSpaced(springs.size(), -1, 2);
    const Eigen::MatrixXd dense(lower), whole = dense.selfadjointView<Eigen::Lower>();
    const Eigen::VectorXd moves = whole.llt().solve(forces);
    EXPECT_LT((solved(factor, forces) - moves).norm(), 1e-12 * moves.norm());
    EXPECT_LT(factor.fronts(), std::size_t(springs.size()) / 2) << "unknowns go together";
  }
}

TEST(FrontFactor, MakesAnewWhatHasChangedOnly) {
  const Springs springs(17);
  auto lower = springs.lower();
  FrontFactor kept;
  kept.lay_fronts(lower);
  ASSERT_TRUE(kept.factorize(lower));
  EXPECT_EQ(kept.renewed(), kept.fronts());
  ASSERT_TRUE(kept.factorize(lower));
  EXPECT_EQ(kept.renewed(), 0U);
  const int turned = springs.place_of(0, 16);
  lower.coeffRef(turned, turned) += 3.0;
  ASSERT_TRUE(kept.factorize(lower));
  EXPECT_GT(kept.renewed(), 0U);
  EXPECT_LT(kept.renewed(), kept.fronts() / 2);
  FrontFactor anew;
  anew.lay_fronts(lower);
  ASSERT_TRUE(anew.factorize(lower));
  const Eigen::VectorXd forces = Eigen::VectorXd::LinSpaced(springs.size(), 1, 2);
  EXPECT_EQ(solved(kept, forces), solved(anew, forces)) << "to the last bit";
}

TEST(FrontFactor, CompliesAlongDirectionsAsADenseFactorDoes) {
  const Springs springs(9);
  const auto lower = springs.lower();
  FrontFactor factor;
  factor.lay_fronts(lower);
  ASSERT_TRUE(factor.factorize(lower));
  // along one unknown, along a few, along all; one twice, and one along nothing
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(6, springs.size());
  directions(0, springs.place_of(2, 3)) = 1.0;
  for (int k = 0; k < 5; ++k) directions(1, springs.place_of(k, k)) = 0.3 * k - 0.5;
  directions.row(2).setLinSpaced(-1, 2);
  directions(3, 0) = directions(3, springs.size() - 1) = -2.0;
  directions.row(4) = directions.row(1);
  const Eigen::MatrixXd dense(lower), whole = dense.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd wanted = directions * whole.llt().solve(directions.transpose());
  const Eigen::MatrixXd found = factor.compliance(directions.sparseView());
  EXPECT_LT((found - wanted).norm(), 1e-12 * wanted.norm());
  EXPECT_EQ(found, found.transpose());
}

TEST(FrontFactor, SaysWhereThereIsNone) {
  const Springs springs(6);
  auto lower = springs.lower();
  FrontFactor factor;
  factor.lay_fronts(lower);
  const auto good = lower;
  for (Eigen::Index k = 0; k < lower.cols(); ++k) lower.coeffRef(int(k), int(k)) = 0.0;
  EXPECT_FALSE(factor.factorize(lower));
  EXPECT_TRUE(factor.factorize(good));
  EXPECT_EQ(factor.renewed(), factor.fronts());
}

/// Growth may leave as many unknowns as there were, with other numbers: in an order that was made
/// for the old ones the factor would fill up the memory.
TEST(CoarsestFactor, OrdersAnewWhereUnknownsHaveOtherNumbers) {
  const Springs springs(17);
  const auto size = std::size_t(springs.size());
  std::vector<int> number(size);
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(3));
  StiffnessEntries renumbered;
  for (const auto& e : springs.entries())
    renumbered.emplace_back(number[std::size_t(e.row())], number[std::size_t(e.col())], e.value());
  CoarsestFactor kept, anew;
  ASSERT_TRUE(kept.compute(size, springs.entries()));
  ASSERT_TRUE(kept.compute(size, renumbered));
  ASSERT_TRUE(anew.compute(size, renumbered));
  EXPECT_LT(double(kept.entries()), 1.5 * double(anew.entries()));
  Eigen::VectorXd by_kept = Eigen::VectorXd::LinSpaced(springs.size(), 1, 2), by_anew = by_kept;
  kept.solve(by_kept);
  anew.solve(by_anew);
  EXPECT_LT((by_kept - by_anew).norm(), 1e-10 * by_anew.norm());
}

}  // namespace
}  // namespace cdca::testing
