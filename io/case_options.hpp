// SPDX-License-Identifier: BSD-3-Clause
/// Every key of a case file, declared once. Validation, the manual page, the defaults and the
/// effective input written beside the results all come from this table.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cdca {

enum class OptionKind {
  text,
  choice,  ///< one of a few words
  boolean,
  integer,
  number,
  automatic,  ///< a number, or "auto"
  load,       ///< a number, or an expression in x, y and s
  support,    ///< a load, or "free"
};

enum class OptionShape {
  single,
  pair,              ///< [x, y]
  list,              ///< at least one value
  points,            ///< at least two pairs
  limits,            ///< [low, high]
  single_or_limits,  ///< one value, or [low, high]
  box,               ///< [x0, y0, x1, y1], lower left and upper right corner
};

/// Allowed values of a number, with or without the ends.
struct OptionRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_allowed = true;
  bool high_allowed = true;

  bool holds(double value) const {
    return (low_allowed ? value >= low : value > low) &&
           (high_allowed ? value <= high : value < high);
  }
};

struct Option {
  std::string_view section;  ///< name of the table; empty for keys at the top of the file
  std::string_view key;
  OptionKind kind = OptionKind::number;
  OptionShape shape = OptionShape::single;
  std::string_view unit = {};
  OptionRange range = {};
  std::string_view choices = {};  ///< words separated by '|', for OptionKind::choice
  bool whole_key_later = false;   ///< for later versions altogether
  bool required = false;
  std::string_view standard = {};  ///< default, as TOML; empty: none
  std::string_view excludes =
      {};  ///< keys of the same section, separated by '|', that this one replaces
  /// No default where another key of the section says a word: "mode=critical".
  std::string_view no_standard_if = {};
  std::string_view text = {};  ///< what it means

  /// As in messages: "material.young".
  std::string path() const;
};

struct OptionSection {
  std::string_view name;
  bool repeated = false;  ///< blocks [[name]]
  bool later = false;     ///< for later versions altogether
  bool optional = false;  ///< a table that means something by being there; not filled in
  std::string_view text = {};
};

/// All sections and all options, in the order of the manual.
std::span<const OptionSection> option_sections();
std::span<const Option> options();

/// The options of a section, in order.
std::vector<const Option*> options_of(std::string_view section);
/// None when there is no such key.
const Option* find_option(std::string_view section, std::string_view key);
const OptionSection* find_section(std::string_view name);

/// The parts of a list as "a|b|c".
std::vector<std::string> words_of(std::string_view list);

/// The words in quotes, as a part of a sentence: `"a", "b" or "c"`.
std::string quoted_words(const std::vector<std::string>& words, std::string_view conjunction);

/// What the option takes, as a part of a sentence: "a number in Pa, greater than 0".
std::string allowed_text(const Option& option);

}  // namespace cdca
