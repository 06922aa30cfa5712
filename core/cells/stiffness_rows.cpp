// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/stiffness_rows.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace cdca {

double StiffnessRows::times(std::size_t row, std::span<const double> x, LocalId end) const {
  // several sums side by side: near tips large products cancel, and a single long sum would round
  // them all at the size of the largest
  constexpr std::size_t lanes = 8;
  std::array<double, lanes> sums{};
  std::size_t k = start[row];
  const std::size_t last = start[row + 1];
  for (; k + lanes <= last && column[k + lanes - 1] < end; k += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) sums[l] += value[k + l] * x[std::size_t(column[k + l])];
  }
  for (; k < last; ++k) {
    if (column[k] < end) sums[k % lanes] += value[k] * x[std::size_t(column[k])];
  }
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

std::ptrdiff_t StiffnessRows::find(LocalId u) const {
  const auto it = std::lower_bound(unknown.begin(), unknown.end(), u);
  return it != unknown.end() && *it == u ? it - unknown.begin() : -1;
}

void StiffnessRows::add(const std::vector<LocalId>& unknowns, const Eigen::MatrixXd& matrix,
                        LocalId owned) {
  std::vector<std::size_t> order(unknowns.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return unknowns[a] < unknowns[b]; });
  for (std::size_t a = 0; a < unknowns.size(); ++a) {
    const std::ptrdiff_t row = find(unknowns[a]);
    if (row < 0) continue;
    std::size_t k = start[std::size_t(row)];
    for (const std::size_t b : order) {
      if (unknowns[a] >= owned && unknowns[b] >= owned) break;
      while (column[k] < unknowns[b]) ++k;
      value[k] += matrix(Eigen::Index(a), Eigen::Index(b));
    }
  }
}

void RowSum::add(std::vector<LocalId> unknowns, Eigen::MatrixXd matrix) {
  made_.push_back(std::move(matrix));
  addends_.push_back({std::move(unknowns), made_.back().data()});
}

void RowSum::refer_to(std::vector<LocalId> unknowns, const Eigen::Matrix<double, 8, 8>& matrix) {
  addends_.push_back({std::move(unknowns), matrix.data()});
}

std::vector<RowSum::Part> RowSum::parts_by_unknown(const std::vector<char>& wanted,
                                                   std::vector<std::size_t>& end) const {
  end.assign(wanted.size() + 1, 0);
  for (const Addend& a : addends_) {
    for (const LocalId u : a.unknowns)
      end[std::size_t(u) + 1] += std::size_t(wanted[std::size_t(u)]);
  }
  for (std::size_t r = 1; r < end.size(); ++r) end[r] += end[r - 1];
  std::vector<Part> parts(end.back());
  for (const Addend& a : addends_) {
    for (std::size_t k = 0; k < a.unknowns.size(); ++k) {
      const auto u = std::size_t(a.unknowns[k]);
      if (wanted[u]) parts[end[u]++] = {&a, k};
    }
  }
  return parts;
}

StiffnessRows RowSum::rows(const std::vector<char>& wanted, LocalId owned) const {
  std::vector<std::size_t> end;
  const auto parts = parts_by_unknown(wanted, end);
  std::vector<double> sum(wanted.size(), 0.0);
  std::vector<char> found(wanted.size(), 0);
  std::vector<LocalId> columns;
  StiffnessRows rows;
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    const std::size_t first = r == 0 ? 0 : end[r - 1];
    if (first == end[r]) continue;
    const LocalId last = LocalId(r) < owned ? LocalId(wanted.size()) : owned;
    columns.clear();
    for (std::size_t p = first; p < end[r]; ++p) {
      const auto& unknowns = parts[p].addend->unknowns;
      const double* matrix = parts[p].addend->matrix;
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        const LocalId c = unknowns[k];
        if (c >= last) continue;
        const auto at = std::size_t(c);
        if (!std::exchange(found[at], 1)) columns.push_back(c);
        if (matrix) sum[at] += matrix[parts[p].row + k * unknowns.size()];
      }
    }
    std::sort(columns.begin(), columns.end());
    if (columns.empty()) continue;
    rows.unknown.push_back(LocalId(r));
    for (const LocalId c : columns) {
      rows.column.push_back(c);
      rows.value.push_back(std::exchange(sum[std::size_t(c)], 0.0));
      found[std::size_t(c)] = 0;
    }
    rows.start.push_back(rows.column.size());
  }
  return rows;
}

}  // namespace cdca
