// SPDX-License-Identifier: BSD-3-Clause
/// The values of a case file with the places where they were written, free of any file format.
#pragma once

#include "core/base/errors.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cdca {

enum class ConfigKind { boolean, integer, number, text, date, list, table };

/// A value, a list of values or a table of named values.
struct ConfigNode {
  ConfigKind kind = ConfigKind::table;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0.0;             ///< of an integer too
  std::string text;                ///< of a text; of a date as it was written
  std::vector<std::string> keys;   ///< of a table, one for every item
  std::vector<ConfigNode> items;   ///< of a list or a table
  int line = 0;                    ///< 1-based; 0 when the value comes from no file
  bool from_command_line = false;  ///< set by --set
  bool is_default = false;         ///< not given, filled in from the table of options

  bool is_number() const { return kind == ConfigKind::integer || kind == ConfigKind::number; }

  /// The value of a key of a table; none when the key is absent or this is no table.
  const ConfigNode* find(std::string_view key) const;
  ConfigNode* find(std::string_view key);
  /// Gives a key of a table its value, and returns it in its new place.
  ConfigNode& set(std::string_view key, ConfigNode value);
  void erase(std::string_view key);
};

ConfigNode text_node(std::string_view text);

/// What was found, as a part of a sentence: `the text "abc"`, "0.7", "a list of 3 values".
std::string describe(const ConfigNode& node);

/// The value as TOML on one line; reading it again gives the same value.
std::string toml_value(const ConfigNode& node);

/// A double as the shortest TOML number that reads back the same.
std::string toml_number(double value);

/// A problem with a value. `message` is a sentence; one about a value that --set gave says so, as
/// no line can be named for it.
Problem problem_at(const ConfigNode& node, std::string key, std::string message);

}  // namespace cdca
