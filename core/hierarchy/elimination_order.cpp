// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/elimination_order.hpp"

#include <Eigen/OrderingMethods>

#include <algorithm>
#include <numeric>

namespace cdca {

Eigen::VectorXi elimination_order(std::size_t size, const StiffnessEntries& entries) {
  using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  Eigen::VectorXi as_they_are(static_cast<Eigen::Index>(size));
  std::iota(as_they_are.begin(), as_they_are.end(), 0);
  const auto matrix = in_order(as_they_are, entries, false);
  Permutation eliminated;
  Eigen::AMDOrdering<int>()(matrix.selfadjointView<Eigen::Lower>(), eliminated);
  return Permutation(eliminated.inverse()).indices();
}

Eigen::SparseMatrix<double> in_order(const Eigen::VectorXi& place, const StiffnessEntries& entries,
                                     bool both) {
  struct Lower {
    int column;
    double value;
  };
  const auto size = std::size_t(place.size());
  // by rows first, so that those of every column come with ascending rows
  std::vector<int> row_end(size + 1, 0), column_end(size + 1, 0);
  const auto for_lower = [&](const auto& visit) {
    for (const auto& e : entries) {
      const int row = place[e.row()], column = place[e.col()];
      if (both && row < column) continue;
      visit(std::size_t(std::max(row, column)), std::min(row, column), e.value());
    }
  };
  for_lower([&](std::size_t row, int column, double) {
    ++row_end[row + 1];
    ++column_end[std::size_t(column) + 1];
  });
  std::partial_sum(row_end.begin(), row_end.end(), row_end.begin());
  std::partial_sum(column_end.begin(), column_end.end(), column_end.begin());
  std::vector<Lower> by_row(std::size_t(row_end.back()));
  for_lower([&](std::size_t row, int column, double value) {
    by_row[std::size_t(row_end[row]++)] = {column, value};
  });
  std::vector<int> rows(by_row.size());
  std::vector<double> values(by_row.size());
  // now row_end[r] is the end of row r, and column_end[c] where column c begins
  int at = 0;
  for (std::size_t row = 0; row < size; ++row) {
    for (; at < row_end[row]; ++at) {
      const Lower& e = by_row[std::size_t(at)];
      const int next = column_end[std::size_t(e.column)]++;
      rows[std::size_t(next)] = int(row);
      values[std::size_t(next)] = e.value;
    }
  }
  Eigen::SparseMatrix<double> matrix(place.size(), place.size());
  matrix.resizeNonZeros(Eigen::Index(by_row.size()));
  int* outer = matrix.outerIndexPtr();
  int count = 0, first = 0;
  for (std::size_t column = 0; column < size; ++column) {
    outer[column] = count;
    const int start = count;
    for (int k = first; k < column_end[column]; ++k) {
      if (count > start && matrix.innerIndexPtr()[count - 1] == rows[std::size_t(k)]) {
        matrix.valuePtr()[count - 1] += values[std::size_t(k)];
      } else {
        matrix.innerIndexPtr()[count] = rows[std::size_t(k)];
        matrix.valuePtr()[count++] = values[std::size_t(k)];
      }
    }
    first = column_end[column];
  }
  outer[size] = count;
  matrix.resizeNonZeros(count);
  return matrix;
}

}  // namespace cdca
