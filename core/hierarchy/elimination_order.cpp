// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/elimination_order.hpp"

#include <Eigen/OrderingMethods>

#include <algorithm>

namespace cdca {

Eigen::VectorXi elimination_order(std::size_t size, const StiffnessEntries& entries) {
  using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  StiffnessEntries lower;
  lower.reserve(entries.size());
  for (const auto& e : entries) {
    const auto [low, high] = std::minmax(e.row(), e.col());
    lower.emplace_back(high, low, 1.0);
  }
  const auto unknowns = Eigen::Index(size);
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(lower.begin(), lower.end());
  Permutation eliminated;
  Eigen::AMDOrdering<int>()(matrix.selfadjointView<Eigen::Lower>(), eliminated);
  return Permutation(eliminated.inverse()).indices();
}

Eigen::SparseMatrix<double> in_order(const Eigen::VectorXi& place, const StiffnessEntries& entries,
                                     bool both) {
  StiffnessEntries lower;
  lower.reserve(entries.size());
  for (const auto& e : entries) {
    const int row = place[e.row()], column = place[e.col()];
    if (both && row < column) continue;
    lower.emplace_back(std::max(row, column), std::min(row, column), e.value());
  }
  Eigen::SparseMatrix<double> matrix(place.size(), place.size());
  matrix.setFromTriplets(lower.begin(), lower.end());
  return matrix;
}

}  // namespace cdca
