// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_overrides.hpp"

#include "io/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace cdca {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// "boundary[1].traction" as boundary, 1, traction; none when a part is empty or a bracket is left
/// open.
std::optional<std::vector<std::string>> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  bool after_bracket = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '[') {
      const auto close = path.find(']', i);
      if (close == std::string::npos) return std::nullopt;
      parts.push_back(path.substr(i + 1, close - i - 1));
      i = close;
      after_bracket = true;
    } else if (path[i] == '.') {
      parts.emplace_back();
      after_bracket = false;
    } else if (after_bracket) {
      return std::nullopt;
    } else {
      parts.back() += path[i];
    }
  }
  if (std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.empty(); })) {
    return std::nullopt;
  }
  return parts;
}

bool is_count(const std::string& text) {
  return text.size() < 10 && std::all_of(text.begin(), text.end(),
                                         [](unsigned char c) { return std::isdigit(c) != 0; });
}

ConfigNode value_of(const std::string& text) {
  auto value = parse_toml_value(text);
  return value ? *value : text_node(text);
}

/// Everything below was set by the command line too: messages about an entry must say so.
void mark(ConfigNode& node) {
  node.line = 0;
  node.from_command_line = true;
  for (auto& item : node.items) mark(item);
}

[[noreturn]] void refuse(const std::string& path, const std::string& sentence) {
  throw InputError(0, path, sentence);
}

/// The entry `part` of a list, a block or a table; a table gets it when it is new.
ConfigNode& entry(ConfigNode& node, const std::string& part, const std::string& path) {
  if (node.kind == ConfigKind::table) {
    ConfigNode* present = node.find(part);
    if (present) return *present;
    ConfigNode fresh;
    fresh.from_command_line = true;
    return node.set(part, fresh);
  }
  if (node.kind != ConfigKind::list) {
    refuse(path, fmt::format("The command line sets \"{}\" inside of {}, which has no entries.",
                             part, describe(node)));
  }
  if (!is_count(part)) {
    refuse(path,
           fmt::format("The command line names \"{}\" where the number of an entry is needed, "
                       "counted from 0 as in \"[0]\".",
                       part));
  }
  const auto index = static_cast<std::size_t>(std::stol(part));
  if (index >= node.items.size()) {
    refuse(path,
           fmt::format("The command line sets entry {}, but the case file has {}; entries are "
                       "counted from 0.",
                       index, node.items.size()));
  }
  return node.items[index];
}

void apply(ConfigNode& root, const std::string& setting) {
  const auto equals = setting.find('=');
  const auto path = trimmed(setting.substr(0, equals));
  const auto parts = parts_of(path);
  if (equals == std::string::npos || !parts) {
    refuse(
        "--set",
        fmt::format("The setting \"{}\" on the command line cannot be read; allowed is "
                    "key.path=value, as in material.young=76e9 or boundary[1].traction=[0, 1e6].",
                    setting));
  }
  ConfigNode value = value_of(trimmed(setting.substr(equals + 1)));
  mark(value);
  ConfigNode* place = &root;
  for (const auto& part : *parts) place = &entry(*place, part, path);
  *place = std::move(value);
}

}  // namespace

void apply_overrides(ConfigNode& root, const std::vector<std::string>& settings,
                     std::vector<Problem>& problems) {
  for (const auto& setting : settings) {
    try {
      apply(root, setting);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
}

}  // namespace cdca
