// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/kept_rows.hpp"

#include <limits>

namespace cdca {

namespace {

/// Adds a row as it is but for its number; values: of all rows that it is one of.
void add_row(const StiffnessRows& from, const std::vector<double>& values, std::size_t row,
             LocalId unknown, StiffnessRows& to) {
  const auto first = std::ptrdiff_t(from.start[row]), last = std::ptrdiff_t(from.start[row + 1]);
  to.unknown.push_back(unknown);
  to.column.insert(to.column.end(), from.column.begin() + first, from.column.begin() + last);
  to.value.insert(to.value.end(), values.begin() + first, values.begin() + last);
  to.start.push_back(to.column.size());
}

}  // namespace

KeptRows::KeptRows(const CarriedCells* carried, std::size_t count) : carried_(carried) {
  if (!carried) return;
  row_of_.assign(count, -1);
  const auto& before = carried->before().rows().unknown;
  kept_.assign(before.size(), 0);
  for (std::size_t r = 0; r < before.size(); ++r) {
    const LocalId u = carried->now(before[r]);
    if (u >= 0) row_of_[std::size_t(u)] = std::ptrdiff_t(r);
  }
}

bool KeptRows::keep(LocalId node, const std::vector<LocalId>& unknowns) {
  if (!carried_ || !carried_->same_rows(node)) return false;
  for (const LocalId u : unknowns) {
    if (row_of_[std::size_t(u)] < 0) return false;
  }
  for (const LocalId u : unknowns) kept_[std::size_t(row_of_[std::size_t(u)])] = 1;
  return true;
}

StiffnessRows KeptRows::with(StiffnessRows made) const {
  if (!carried_) return made;
  const StiffnessRows& before = carried_->before().rows();
  const auto& values = carried_->before().without_springs();
  StiffnessRows all;
  std::size_t m = 0;
  const auto add_made = [&](LocalId end) {
    for (; m < made.unknown.size() && made.unknown[m] < end; ++m)
      add_row(made, made.value, m, made.unknown[m], all);
  };
  for (std::size_t r = 0; r < before.unknown.size(); ++r) {
    if (!kept_[r]) continue;
    const LocalId unknown = carried_->now(before.unknown[r]);
    add_made(unknown);
    const std::size_t first = all.column.size();
    add_row(before, values, r, unknown, all);
    for (std::size_t k = first; k < all.column.size(); ++k)
      all.column[k] = carried_->now(all.column[k]);
  }
  add_made(std::numeric_limits<LocalId>::max());
  return all;
}

}  // namespace cdca
