// SPDX-License-Identifier: BSD-3-Clause
#include "io/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace cdca {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Inserted, lost, wrong and swapped letters between two words; capitals do not count.
std::size_t slips(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = std::move(last);
    last = std::move(row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest_spelling(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t fewest = word.size();
  for (const auto& candidate : candidates) {
    const auto count = slips(word, candidate);
    const auto bearable = std::max<std::size_t>(1, std::max(word.size(), candidate.size()) / 3);
    if (count <= bearable && count < fewest) {
      fewest = count;
      best = candidate;
    }
  }
  if (!best.empty() || word.size() < 3) return best;
  const auto longer =
      std::find_if(candidates.begin(), candidates.end(),
                   [&](const auto& candidate) { return candidate.starts_with(word); });
  return longer == candidates.end() ? "" : *longer;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                         const std::string& otherwise) {
  const auto nearest = nearest_spelling(word, candidates);
  return nearest.empty() ? otherwise : fmt::format("; did you mean \"{}\"?", nearest);
}

}  // namespace cdca
