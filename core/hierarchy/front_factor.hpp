// SPDX-License-Identifier: BSD-3-Clause
/// A factor made of small dense ones, of which only those are made anew that have to be.
#pragma once

#include <Eigen/SparseCore>

#include <vector>

namespace cdca {

/// K = L D L^T. Unknowns next to each other that couple to the same later ones are eliminated
/// together, in a dense front that holds them and those later ones (multifrontal method). What they
/// leave for the later ones is kept, so that where values change only the fronts with these values
/// and those that come after them are eliminated again: turned springs change few of them.
class FrontFactor {
 public:
  /// lower: the lower triangle, all diagonal entries included, in an order of elimination with
  /// little fill-in; only where its entries stand counts.
  void lay_fronts(const Eigen::SparseMatrix<double>& lower);
  /// lower: with its entries where they stood. Returns whether there is a factor.
  bool factorize(const Eigen::SparseMatrix<double>& lower);
  /// values = K^-1 values.
  void solve(Eigen::VectorXd& values) const;
  /// R K^-1 R^T. directions: R, a row for each, which may have few entries.
  Eigen::MatrixXd compliance(const Eigen::SparseMatrix<double>& directions) const;

  /// Entries of L that are kept, as soon as fronts are laid.
  Eigen::Index entries() const { return entries_; }
  /// Fronts eliminated by the last factorize(), and all of them.
  std::size_t renewed() const { return renewed_; }
  std::size_t fronts() const { return fronts_.size(); }

 private:
  struct Front {
    int first = 0;                ///< this unknown
    int count = 1;                ///< and those that follow, so many in all, are eliminated here
    std::vector<int> later = {};  ///< unknowns that they couple to, ascending
    double zeros = 0.0;           ///< among its entries of L
    std::size_t lower = 0;        ///< where its columns of L begin; the diagonal holds D
    std::size_t rest = 0;         ///< where what it leaves for the later ones begins
    std::vector<int> rows_in_next = {};  ///< of the later ones, in the front that takes this up

    Eigen::Index rows() const { return count + Eigen::Index(later.size()); }
  };
  using Dense = Eigen::Map<Eigen::MatrixXd>;
  using ConstDense = Eigen::Map<const Eigen::MatrixXd>;

  bool joins_the_one_before();
  void number_entries();
  void link_fronts(int unknowns);
  void assemble(const Front& front, const Eigen::SparseMatrix<double>& lower);
  void add_rest(const Front& before, const Front& front);
  bool eliminate(const Front& front);
  Dense lower_of(const Front& f) { return {lower_.data() + f.lower, f.rows(), f.count}; }
  class Compliance;
  ConstDense lower_of(const Front& f) const { return {lower_.data() + f.lower, f.rows(), f.count}; }
  Dense rest_of(const Front& f) {
    return {rest_.data() + f.rest, f.rows() - f.count, f.rows() - f.count};
  }

  std::vector<Front> fronts_;
  std::vector<std::vector<int>> taken_up_;  ///< by front: those whose rest it takes up
  Eigen::Index entries_ = 0, rest_entries_ = 0;
  std::vector<double> lower_, rest_;  ///< empty until the first factor
  std::vector<double> values_;        ///< that the fronts were made for
  std::vector<int> row_;              ///< of unknowns in the front at hand
  std::size_t renewed_ = 0;
};

}  // namespace cdca
