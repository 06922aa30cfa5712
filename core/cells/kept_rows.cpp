// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/kept_rows.hpp"

#include <algorithm>
#include <limits>

namespace cdca {

KeptRows::KeptRows(const CarriedCells* carried) : carried_(carried) {
  if (!carried) return;
  const auto& before = carried->before().rows().unknown;
  kept_.assign(before.size(), 0);
  for (std::size_t r = 0; r < before.size(); ++r) {
    const LocalId u = carried->now(before[r]);
    if (u < 0) continue;
    now_.push_back(u);
    row_.push_back(r);
  }
}

bool KeptRows::keep(LocalId node, const std::vector<LocalId>& unknowns) {
  if (!carried_ || !carried_->same_rows(node)) return false;
  rows_of_cell_.clear();
  for (const LocalId u : unknowns) {
    // cells and their unknowns mostly follow each other
    if (next_ == now_.size() || now_[next_] != u) {
      next_ = std::size_t(std::lower_bound(now_.begin(), now_.end(), u) - now_.begin());
      if (next_ == now_.size() || now_[next_] != u) return false;
    }
    rows_of_cell_.push_back(row_[next_++]);
  }
  for (const std::size_t r : rows_of_cell_) kept_[r] = 1;
  return true;
}

StiffnessRows KeptRows::with(StiffnessRows made) const {
  if (!carried_) return made;
  const StiffnessRows& before = carried_->before().rows();
  const auto& values = carried_->before().without_springs();
  StiffnessRows all;
  all.unknown.reserve(before.unknown.size() + made.unknown.size());
  all.start.reserve(before.start.size() + made.start.size());
  all.column.reserve(before.column.size() + made.column.size());
  all.value.reserve(before.value.size() + made.value.size());
  const auto add = [&all](const StiffnessRows& from, const std::vector<double>& values_of_all,
                          std::size_t first, std::size_t end) {
    const auto a = std::ptrdiff_t(from.start[first]), b = std::ptrdiff_t(from.start[end]);
    const std::size_t shift = all.column.size();
    all.column.insert(all.column.end(), from.column.begin() + a, from.column.begin() + b);
    all.value.insert(all.value.end(), values_of_all.begin() + a, values_of_all.begin() + b);
    for (std::size_t r = first; r < end; ++r)
      all.start.push_back(from.start[r + 1] - std::size_t(a) + shift);
  };
  std::size_t m = 0;
  const auto add_made = [&](LocalId end) {
    const std::size_t first = m;
    while (m < made.unknown.size() && made.unknown[m] < end)
      all.unknown.push_back(made.unknown[m++]);
    if (m > first) add(made, made.value, first, m);
  };
  for (std::size_t r = 0; r < kept_.size();) {
    if (!kept_[r]) {
      ++r;
      continue;
    }
    add_made(carried_->now(before.unknown[r]));
    // all rows up to the next one made anew, at once
    const std::size_t first = r;
    const LocalId next =
        m < made.unknown.size() ? made.unknown[m] : std::numeric_limits<LocalId>::max();
    for (; r < kept_.size() && kept_[r]; ++r) {
      const LocalId unknown = carried_->now(before.unknown[r]);
      if (unknown > next) break;
      all.unknown.push_back(unknown);
    }
    const std::size_t shift = all.column.size();
    add(before, values, first, r);
    for (std::size_t k = shift; k < all.column.size(); ++k)
      all.column[k] = carried_->now(all.column[k]);
  }
  add_made(std::numeric_limits<LocalId>::max());
  return all;
}

}  // namespace cdca
