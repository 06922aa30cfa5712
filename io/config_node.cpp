// SPDX-License-Identifier: BSD-3-Clause
#include "io/config_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cdca {
namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string joined(const ConfigNode& node) {
  std::string out;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) out += ", ";
    if (node.kind == ConfigKind::table) out += quoted(node.keys[i]) + " = ";
    out += toml_value(node.items[i]);
  }
  return out;
}

/// Given by --set, at least one entry of it.
bool is_set(const ConfigNode& node) {
  if (node.from_command_line || node.kind != ConfigKind::list) return node.from_command_line;
  return std::any_of(node.items.begin(), node.items.end(), is_set);
}

}  // namespace

const ConfigNode* ConfigNode::find(std::string_view key) const {
  const auto place = std::find(keys.begin(), keys.end(), key);
  return place == keys.end() ? nullptr : &items[static_cast<std::size_t>(place - keys.begin())];
}

ConfigNode* ConfigNode::find(std::string_view key) {
  return const_cast<ConfigNode*>(static_cast<const ConfigNode*>(this)->find(key));
}

ConfigNode& ConfigNode::set(std::string_view key, ConfigNode value) {
  if (ConfigNode* present = find(key)) return *present = std::move(value);
  keys.emplace_back(key);
  return items.emplace_back(std::move(value));
}

void ConfigNode::erase(std::string_view key) {
  const auto place = std::find(keys.begin(), keys.end(), key);
  if (place == keys.end()) return;
  items.erase(items.begin() + (place - keys.begin()));
  keys.erase(place);
}

ConfigNode text_node(std::string_view text) {
  ConfigNode node;
  node.kind = ConfigKind::text;
  node.text = text;
  return node;
}

std::string describe(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigKind::text:
      return node.text.empty() ? "an empty text" : "the text " + quoted(node.text);
    case ConfigKind::list:
      return node.items.size() == 1 ? "a list of 1 value"
                                    : fmt::format("a list of {} values", node.items.size());
    case ConfigKind::table: return "a table";
    case ConfigKind::date: return "the date or time " + node.text;
    default: return toml_value(node);
  }
}

std::string toml_value(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigKind::boolean: return node.boolean ? "true" : "false";
    case ConfigKind::integer: return fmt::format("{}", node.integer);
    case ConfigKind::number: return toml_number(node.number);
    case ConfigKind::text: return quoted(node.text);
    case ConfigKind::date: return node.text;
    case ConfigKind::list: return "[" + joined(node) + "]";
    case ConfigKind::table: return "{" + joined(node) + "}";
  }
  return {};
}

std::string toml_number(double value) {
  auto text = fmt::format("{}", value);
  if (std::isfinite(value) && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

Problem problem_at(const ConfigNode& node, std::string key, std::string message) {
  if (!is_set(node)) return {node.line, std::move(key), std::move(message)};
  if (!message.empty() && message.back() == '.') message.pop_back();
  return {0, std::move(key), message + " (this was set on the command line)."};
}

}  // namespace cdca
