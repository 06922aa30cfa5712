// SPDX-License-Identifier: BSD-3-Clause
/// A factor that outlasts changes of the stiffness.
#pragma once

#include "core/hierarchy/elimination_order.hpp"
#include "core/hierarchy/front_factor.hpp"

#include <cstdint>
#include <span>

namespace cdca {

/// While entries stand where they stood, as when only springs turn, places and fill-in are known
/// from before. The order of elimination outlasts small changes of the cracks, too: a factor that
/// has become too large for it asks for a new one.
class CoarsestFactor {
 public:
  /// Of every pair of coupled unknowns one entry counts. Returns whether there is a factor.
  bool compute(std::size_t size, const StiffnessEntries& entries);
  /// The same entries with other values.
  bool compute_again(std::span<const double> values);
  /// Entries of L that are kept.
  Eigen::Index entries() const { return factor_.entries(); }
  /// values = K^-1 values, by unknown.
  void solve(Eigen::VectorXd& values) const;
  /// R K^-1 R^T. directions: entries of R: number of a direction, unknown, value.
  Eigen::MatrixXd compliance(std::size_t count, const StiffnessEntries& directions) const;

 private:
  bool same_places(std::size_t size, const StiffnessEntries& entries) const;
  void lay_places(std::size_t size, const StiffnessEntries& entries);
  void lay_fronts(const StiffnessEntries& entries);
  template <class ValueOf>
  bool factorize(const ValueOf& value_of);

  Eigen::VectorXi place_;              ///< of every unknown in the factor
  Eigen::Index entries_of_order_ = 0;  ///< of the factor that the order was made for
  std::vector<std::uint64_t> places_;  ///< row and column of every entry
  std::vector<std::size_t> at_;        ///< of every entry among the values of matrix_
  Eigen::SparseMatrix<double> matrix_;
  FrontFactor factor_;
};

}  // namespace cdca
