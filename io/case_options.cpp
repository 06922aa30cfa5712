// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cdca {
namespace {

std::string range_text(const OptionRange& range) {
  const bool has_low = std::isfinite(range.low);
  const bool has_high = std::isfinite(range.high);
  const auto low = fmt::format("{} {}", range.low_allowed ? "at least" : "greater than", range.low);
  const auto high = fmt::format("{} {}", range.high_allowed ? "at most" : "less than", range.high);
  if (has_low && has_high) return low + " and " + high;
  if (has_low) return low;
  return has_high ? high : "";
}

std::string value_text(const Option& option) {
  const auto unit = option.unit.empty() ? "" : fmt::format(" in {}", option.unit);
  switch (option.kind) {
    case OptionKind::text: return "a text";
    case OptionKind::choice: return quoted_words(words_of(option.choices), "or");
    case OptionKind::boolean: return "true or false";
    case OptionKind::integer: return "a whole number";
    case OptionKind::number: return "a number" + unit;
    case OptionKind::automatic: return "\"auto\" or a number" + unit;
    case OptionKind::load: return "a number" + unit + " or an expression in x, y and s";
    case OptionKind::support:
      return "\"free\", a number" + unit + " or an expression in x, y and s";
  }
  return {};
}

}  // namespace

std::string Option::path() const {
  return section.empty() ? std::string(key) : fmt::format("{}.{}", section, key);
}

std::vector<const Option*> options_of(std::string_view section) {
  std::vector<const Option*> out;
  for (const auto& option : options()) {
    if (option.section == section) out.push_back(&option);
  }
  return out;
}

const Option* find_option(std::string_view section, std::string_view key) {
  const auto all = options();
  const auto place = std::find_if(all.begin(), all.end(), [&](const Option& option) {
    return option.section == section && option.key == key;
  });
  return place == all.end() ? nullptr : &*place;
}

const OptionSection* find_section(std::string_view name) {
  const auto all = option_sections();
  const auto place = std::find_if(
      all.begin(), all.end(), [&](const OptionSection& section) { return section.name == name; });
  return place == all.end() ? nullptr : &*place;
}

std::vector<std::string> words_of(std::string_view list) {
  std::vector<std::string> words;
  while (!list.empty()) {
    const auto end = std::min(list.find('|'), list.size());
    words.emplace_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return words;
}

std::string quoted_words(const std::vector<std::string>& words, std::string_view conjunction) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 == words.size() ? fmt::format(" {} ", conjunction) : ", ";
    out += '"' + words[i] + '"';
  }
  return out;
}

std::string allowed_text(const Option& option) {
  std::string value = value_text(option);
  if (const auto range = range_text(option.range); !range.empty()) value += ", " + range;
  switch (option.shape) {
    case OptionShape::single: return value;
    case OptionShape::pair: return "a pair [x, y], each " + value;
    case OptionShape::list: return "a list of one or more values, each " + value;
    case OptionShape::points:
      return "a list of two or more points [x, y], each coordinate " + value;
    case OptionShape::limits: return "a pair [low, high], each " + value;
    case OptionShape::single_or_limits: return value + ", or a pair [low, high] of such numbers";
    case OptionShape::box: return "a list [x0, y0, x1, y1] with x0 < x1 and y0 < y1, each " + value;
  }
  return value;
}

}  // namespace cdca
