// SPDX-License-Identifier: BSD-3-Clause
/// How a body with a factor made of fronts gives way along some directions.
#include "core/base/dense_product.hpp"
#include "core/hierarchy/front_factor.hpp"

#include <algorithm>
#include <utility>

namespace cdca {

/// R K^-1 R^T = (L^-1 R^T)^T D^-1 (L^-1 R^T). Columns of L^-1 R^T are made front by front: each
/// passes on to the next what the directions that it has met leave for later unknowns.
class FrontFactor::Compliance {
 public:
  Compliance(const FrontFactor& factor, const Eigen::SparseMatrix<double>& directions)
      : factor_(factor),
        directions_(directions),
        passed_(factor.fronts_.size()),
        place_(std::size_t(directions.rows()), -1),
        sum_(Eigen::MatrixXd::Zero(directions.rows(), directions.rows())) {}

  Eigen::MatrixXd sum() && {
    for (std::size_t f = 0; f < passed_.size(); ++f) {
      meet_directions(f);
      if (!passed_[f].directions.empty()) eliminate(f);
    }
    sum_.triangularView<Eigen::StrictlyUpper>() = sum_.transpose();
    return std::move(sum_);
  }

 private:
  struct Passed {
    std::vector<int> directions;  ///< ascending
    Eigen::MatrixXd rows;         ///< for the later unknowns, a column for each direction
  };

  /// Those of its own unknowns, and those of the fronts that this one takes up.
  void meet_directions(std::size_t f) {
    std::vector<int>& met = passed_[f].directions;
    const auto meet = [&](int direction) {
      if (std::exchange(place_[std::size_t(direction)], 0) < 0) met.push_back(direction);
    };
    const Front& front = factor_.fronts_[f];
    for (int k = 0; k < front.count; ++k) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(directions_, front.first + k); it; ++it)
        meet(int(it.row()));
    }
    for (const int b : factor_.taken_up_[f])
      std::ranges::for_each(passed_[std::size_t(b)].directions, meet);
    std::ranges::sort(met);
    for (std::size_t k = 0; k < met.size(); ++k) place_[std::size_t(met[k])] = int(k);
  }

  void eliminate(std::size_t f) {
    const Front& front = factor_.fronts_[f];
    const std::vector<int>& met = passed_[f].directions;
    Eigen::MatrixXd all = assembled(f);
    const ConstDense l = factor_.lower_of(front);
    const Eigen::Index left = all.rows() - front.count;
    auto own = all.topRows(front.count);
    l.topRows(front.count).triangularView<Eigen::UnitLower>().solveInPlace(own);
    passed_[f].rows = all.bottomRows(left);
    add_product(-1.0, l.bottomRows(left), own, Transposed::neither, passed_[f].rows);
    add_to_sum(own, l.diagonal().cwiseInverse(), met);
    for (const int direction : met) place_[std::size_t(direction)] = -1;
  }

  /// A few columns at a time: the sum itself is large enough.
  void add_to_sum(const Eigen::MatrixXd& own, const Eigen::VectorXd& weights,
                  const std::vector<int>& met) {
    constexpr Eigen::Index most = 512;
    for (Eigen::Index first = 0; first < own.cols(); first += most) {
      const Eigen::Index count = std::min(most, own.cols() - first), left = own.cols() - first;
      const Eigen::MatrixXd weighted = weights.asDiagonal() * own.middleCols(first, count);
      Eigen::MatrixXd part = Eigen::MatrixXd::Zero(left, count);
      add_product(1.0, own.rightCols(left), weighted, Transposed::first, part);
      for (Eigen::Index c = 0; c < count; ++c) {
        double* column = &sum_(0, met[std::size_t(first + c)]);
        for (Eigen::Index r = c; r < left; ++r) column[met[std::size_t(first + r)]] += part(r, c);
      }
    }
  }

  /// Entries of R^T in the rows of a front, with what it takes up.
  Eigen::MatrixXd assembled(std::size_t f) {
    const Front& front = factor_.fronts_[f];
    Eigen::MatrixXd all =
        Eigen::MatrixXd::Zero(front.rows(), Eigen::Index(passed_[f].directions.size()));
    for (int k = 0; k < front.count; ++k) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(directions_, front.first + k); it; ++it)
        all(k, place_[std::size_t(it.row())]) = it.value();
    }
    for (const int b : factor_.taken_up_[f]) {
      const Passed before = std::exchange(passed_[std::size_t(b)], {});
      const auto& to = factor_.fronts_[std::size_t(b)].rows_in_next;
      for (Eigen::Index c = 0; c < before.rows.cols(); ++c) {
        auto column = all.col(place_[std::size_t(before.directions[std::size_t(c)])]);
        for (Eigen::Index r = 0; r < before.rows.rows(); ++r)
          column[to[std::size_t(r)]] += before.rows(r, c);
      }
    }
    return all;
  }

  const FrontFactor& factor_;
  const Eigen::SparseMatrix<double>& directions_;
  std::vector<Passed> passed_;  ///< by front
  std::vector<int> place_;      ///< of directions among those that the front at hand has met, or -1
  Eigen::MatrixXd sum_;         ///< lower triangle
};

Eigen::MatrixXd FrontFactor::compliance(const Eigen::SparseMatrix<double>& directions) const {
  return Compliance(*this, directions).sum();
}

}  // namespace cdca
