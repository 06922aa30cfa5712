// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/stiffness_rows.hpp"

#include "core/base/marked.hpp"

#include <algorithm>
#include <array>
#include <memory>
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

void StiffnessRows::append_places(const std::vector<LocalId>& unknowns, LocalId owned,
                                  std::vector<std::size_t>& places) const {
  std::vector<std::size_t> order(unknowns.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return unknowns[a] < unknowns[b]; });
  const std::size_t first = places.size();
  places.resize(first + unknowns.size() * unknowns.size(), nowhere);
  for (std::size_t a = 0; a < unknowns.size(); ++a) {
    const std::ptrdiff_t row = find(unknowns[a]);
    if (row < 0) continue;
    std::size_t k = start[std::size_t(row)];
    for (const std::size_t b : order) {
      if (unknowns[a] >= owned && unknowns[b] >= owned) break;
      while (column[k] < unknowns[b]) ++k;
      places[first + b * unknowns.size() + a] = k;
    }
  }
}

void RowSum::append(std::span<const LocalId> unknowns, const double* matrix) {
  addends_.push_back({unknowns_.size(), unknowns.size(), matrix});
  unknowns_.insert(unknowns_.end(), unknowns.begin(), unknowns.end());
}

void RowSum::add(std::span<const LocalId> unknowns, Eigen::MatrixXd matrix) {
  made_.push_back(std::move(matrix));
  append(unknowns, made_.back().data());
}

void RowSum::refer_to(std::span<const LocalId> unknowns,
                      const Eigen::Matrix<double, 8, 8>& matrix) {
  append(unknowns, matrix.data());
}

void RowSum::make_places(std::span<const LocalId> unknowns) { append(unknowns, nullptr); }

std::vector<RowSum::Part> RowSum::parts_by_unknown(const std::vector<LocalId>& unknowns,
                                                   const std::vector<char>& wanted,
                                                   std::vector<std::size_t>& end) const {
  end.assign(wanted.size() + 1, 0);
  for (const LocalId u : unknowns) end[std::size_t(u) + 1] += std::size_t(wanted[std::size_t(u)]);
  for (std::size_t r = 1; r < end.size(); ++r) end[r] += end[r - 1];
  std::vector<Part> parts(end.back());
  for (const Addend& a : addends_) {
    for (std::size_t k = 0; k < a.size; ++k) {
      const auto u = std::size_t(unknowns[a.first + k]);
      if (wanted[u]) parts[end[u]++] = {&a, k};
    }
  }
  return parts;
}

StiffnessRows RowSum::rows(const std::vector<char>& wanted, LocalId owned) const {
  // few unknowns take part: they are numbered anew, in the same order
  std::vector<char> takes_part(wanted.size(), 0);
  for (const LocalId u : unknowns_) takes_part[std::size_t(u)] = 1;
  const std::vector<LocalId> all = marked(takes_part);
  const auto number = std::make_unique_for_overwrite<LocalId[]>(wanted.size());
  std::vector<char> wanted_here(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    number[std::size_t(all[k])] = LocalId(k);
    wanted_here[k] = wanted[std::size_t(all[k])];
  }
  std::vector<LocalId> unknowns;
  unknowns.reserve(unknowns_.size());
  for (const LocalId u : unknowns_) unknowns.push_back(number[std::size_t(u)]);
  const auto own = LocalId(std::lower_bound(all.begin(), all.end(), owned) - all.begin());

  std::vector<std::size_t> end;
  const auto parts = parts_by_unknown(unknowns, wanted_here, end);
  std::vector<double> sum(all.size(), 0.0);
  std::vector<char> found(all.size(), 0);
  std::vector<LocalId> columns;
  StiffnessRows rows;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const std::size_t first = r == 0 ? 0 : end[r - 1];
    if (first == end[r]) continue;
    const LocalId last = LocalId(r) < own ? LocalId(all.size()) : own;
    columns.clear();
    for (std::size_t p = first; p < end[r]; ++p) {
      const Addend& addend = *parts[p].addend;
      for (std::size_t k = 0; k < addend.size; ++k) {
        const LocalId c = unknowns[addend.first + k];
        if (c >= last) continue;
        const auto at = std::size_t(c);
        if (!std::exchange(found[at], 1)) columns.push_back(c);
        if (addend.matrix) sum[at] += addend.matrix[parts[p].row + k * addend.size];
      }
    }
    std::sort(columns.begin(), columns.end());
    if (columns.empty()) continue;
    rows.unknown.push_back(all[r]);
    for (const LocalId c : columns) {
      rows.column.push_back(all[std::size_t(c)]);
      rows.value.push_back(std::exchange(sum[std::size_t(c)], 0.0));
      found[std::size_t(c)] = 0;
    }
    rows.start.push_back(rows.column.size());
  }
  return rows;
}

}  // namespace cdca
