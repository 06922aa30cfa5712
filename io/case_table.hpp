// SPDX-License-Identifier: BSD-3-Clause
/// Reading the values that validate_case() left in a table.
#pragma once

#include "core/base/types.hpp"
#include "io/config_node.hpp"

#include <array>
#include <optional>
#include <string_view>

namespace cdca {

/// The values of one table; what is absent (wrong and taken out, or optional) leaves its target as
/// it is.
class TableReader {
 public:
  TableReader(const ConfigNode& root, std::string_view section) : table_(root.find(section)) {}

  int line() const { return table_ ? table_->line : 0; }
  const ConfigNode* find(std::string_view key) const {
    return table_ ? table_->find(key) : nullptr;
  }

  void read(std::string_view key, double& target) const {
    if (const auto* node = find(key)) target = node->number;
  }
  void read(std::string_view key, std::optional<double>& target) const {
    if (const auto* node = find(key)) target = node->number;
  }
  void read(std::string_view key, int& target) const {
    if (const auto* node = find(key)) target = static_cast<int>(node->integer);
  }
  void read(std::string_view key, bool& target) const {
    if (const auto* node = find(key)) target = node->boolean;
  }
  void read(std::string_view key, std::array<double, 2>& target) const {
    if (const auto* node = find(key)) target = {node->items[0].number, node->items[1].number};
  }
  void read(std::string_view key, Vec2& target) const {
    if (const auto* node = find(key)) target = {node->items[0].number, node->items[1].number};
  }
  bool says(std::string_view key, std::string_view word) const {
    const auto* node = find(key);
    return node && node->text == word;
  }

 private:
  const ConfigNode* table_;
};

}  // namespace cdca
