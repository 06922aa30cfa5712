// SPDX-License-Identifier: BSD-3-Clause
/// Sets of nodes or elements of a structured grid, as spans of consecutive columns in each row.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cdca {

class RowSpans {
 public:
  /// Columns from first to just before end.
  struct Span {
    int first;
    int end;
  };

  /// Joins a span of a row to the set; call sort() after the last one.
  void add(int row, int first, int end) {
    if (first >= end || row < 0) return;
    if (std::size_t(row) >= rows_.size()) rows_.resize(std::size_t(row) + 1);
    auto& spans = rows_[std::size_t(row)];
    if (!spans.empty() && spans.back().end == first) {
      spans.back().end = end;
    } else {
      spans.push_back({first, end});
    }
  }

  /// Puts the spans of every row in order and joins those that touch.
  void sort() {
    for (auto& spans : rows_) {
      std::sort(spans.begin(), spans.end(),
                [](const Span& a, const Span& b) { return a.first < b.first; });
      std::size_t last = 0;
      for (std::size_t k = 1; k < spans.size(); ++k) {
        if (spans[k].first <= spans[last].end) {
          spans[last].end = std::max(spans[last].end, spans[k].end);
        } else {
          spans[++last] = spans[k];
        }
      }
      if (!spans.empty()) spans.resize(last + 1);
    }
  }

  /// Calls visit(row, span) from row to row and from left to right.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      for (const Span& span : rows_[j]) visit(int(j), span);
    }
  }

  /// The places of this set that are not in the other one; both in order.
  RowSpans without(const RowSpans& other) const {
    RowSpans rest;
    for_each([&](int row, Span span) {
      if (std::size_t(row) < other.rows_.size()) {
        for (const Span& hole : other.rows_[std::size_t(row)]) {
          if (hole.end <= span.first || hole.first >= span.end) continue;
          rest.add(row, span.first, hole.first);
          span.first = hole.end;
        }
      }
      rest.add(row, span.first, span.end);
    });
    return rest;
  }

 private:
  std::vector<std::vector<Span>> rows_;
};

}  // namespace cdca
