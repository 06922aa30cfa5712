// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_value_check.hpp"

#include "io/spelling.hpp"
#include "io/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cdca {
namespace {

using Problems = std::vector<Problem>;

/// Empty when the word is allowed.
std::string choice_mistake(const Option& option, const std::string& word) {
  const auto now = words_of(option.choices);
  if (std::find(now.begin(), now.end(), word) != now.end()) return {};
  const auto allowed = quoted_words(now, "and");
  const std::string verb = now.size() == 1 ? "is" : "are";
  const auto found = fmt::format("Found the text \"{}\"; allowed {} {}", word, verb, allowed);
  return found + did_you_mean(word, now, ".");
}

std::string number_mistake(const Option& option, const ConfigNode& value) {
  if (!std::isfinite(value.number)) {
    return fmt::format("Found {}; allowed are finite numbers only.", describe(value));
  }
  if (option.range.holds(value.number)) return {};
  return fmt::format("Found {}; allowed is {}.", describe(value), allowed_text(option));
}

bool has_type(const Option& option, const ConfigNode& value) {
  switch (option.kind) {
    case OptionKind::text:
    case OptionKind::choice: return value.kind == ConfigKind::text && !value.text.empty();
    case OptionKind::boolean: return value.kind == ConfigKind::boolean;
    case OptionKind::integer: return value.kind == ConfigKind::integer;
    case OptionKind::number: return value.is_number();
    case OptionKind::automatic:
      return value.is_number() || (value.kind == ConfigKind::text && value.text == "auto");
    case OptionKind::load:
    case OptionKind::support:
      return value.is_number() || (value.kind == ConfigKind::text && !value.text.empty());
  }
  return false;
}

/// Empty when the single value (of a pair or list: one entry) is allowed.
std::string mistake(const Option& option, const ConfigNode& value) {
  if (!has_type(option, value)) {
    return fmt::format("Found {}; allowed is {}.", describe(value), allowed_text(option));
  }
  if (option.kind == OptionKind::choice) return choice_mistake(option, value.text);
  return value.is_number() ? number_mistake(option, value) : std::string();
}

void check_single(const Option& option, const ConfigNode& value, const std::string& path,
                  Problems& problems) {
  auto message = mistake(option, value);
  if (!message.empty()) problems.push_back(problem_at(value, path, std::move(message)));
}

/// A list with `least` to `most` entries; says so when it is not.
bool is_list(const Option& option, const ConfigNode& value, std::size_t least, std::size_t most,
             const std::string& path, Problems& problems) {
  const auto count = value.items.size();
  if (value.kind == ConfigKind::list && count >= least && count <= most) return true;
  problems.push_back(problem_at(
      value, path, fmt::format("Found {}; allowed is {}.", describe(value), allowed_text(option))));
  return false;
}

void check_entries(const Option& option, const ConfigNode& value, const std::string& path,
                   Problems& problems) {
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    check_single(option, value.items[i], fmt::format("{}[{}]", path, i), problems);
  }
}

/// A list of values whose first half are the lower limits of the second half.
void check_limits(const Option& option, const ConfigNode& value, const std::string& path,
                  Problems& problems) {
  const bool is_box = option.shape == OptionShape::box;
  const std::size_t half = is_box ? 2 : 1;
  if (!is_list(option, value, 2 * half, 2 * half, path, problems)) return;
  const auto before = problems.size();
  check_entries(option, value, path, problems);
  for (std::size_t i = 0; i < half && problems.size() == before; ++i) {
    const double low = value.items[i].number;
    const double high = value.items[i + half].number;
    if (is_box ? low < high : low <= high) continue;
    problems.push_back(problem_at(
        value, path,
        fmt::format("Found {}; allowed are {}.", toml_value(value),
                    is_box ? "x0 < x1 and y0 < y1" : "limits [low, high] with low at most high")));
  }
}

void check_shape(const Option& option, const ConfigNode& value, const std::string& path,
                 Problems& problems) {
  constexpr auto any = static_cast<std::size_t>(-1);
  switch (option.shape) {
    case OptionShape::single: return check_single(option, value, path, problems);
    case OptionShape::pair:
      if (is_list(option, value, 2, 2, path, problems))
        check_entries(option, value, path, problems);
      return;
    case OptionShape::list:
      if (is_list(option, value, 1, any, path, problems))
        check_entries(option, value, path, problems);
      return;
    case OptionShape::points:
      if (!is_list(option, value, 2, any, path, problems)) return;
      for (std::size_t i = 0; i < value.items.size(); ++i) {
        const auto place = fmt::format("{}[{}]", path, i);
        if (is_list(option, value.items[i], 2, 2, place, problems)) {
          check_entries(option, value.items[i], place, problems);
        }
      }
      return;
    case OptionShape::single_or_limits:
      if (value.kind != ConfigKind::list) return check_single(option, value, path, problems);
      return check_limits(option, value, path, problems);
    case OptionShape::limits:
    case OptionShape::box: return check_limits(option, value, path, problems);
  }
}

}  // namespace

std::string later_sentence(const std::string& kind) {
  return fmt::format("This {} is known, but this version does not support it yet; leave it out.",
                     kind);
}

void check_value(const Option& option, const ConfigNode& value, const std::string& path,
                 Problems& problems) {
  if (option.whole_key_later) {
    problems.push_back(problem_at(value, path, later_sentence("key")));
    return;
  }
  check_shape(option, value, path, problems);
}

}  // namespace cdca
