// SPDX-License-Identifier: BSD-3-Clause
// The only file that knows the TOML library: it takes long to compile.
#include "io/toml_reader.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>

namespace cdca {
namespace {

ConfigNode converted(const toml::node& node);

void convert_table(const toml::table& table, ConfigNode& out) {
  out.kind = ConfigKind::table;
  for (const auto& [key, value] : table) {
    out.keys.emplace_back(key.str());
    out.items.push_back(converted(value));
  }
}

void convert_list(const toml::array& list, ConfigNode& out) {
  out.kind = ConfigKind::list;
  for (const auto& value : list) out.items.push_back(converted(value));
}

template <class Date>
void convert_date(const Date& date, ConfigNode& out) {
  std::ostringstream text;
  text << date;
  out.kind = ConfigKind::date;
  out.text = text.str();
}

ConfigNode converted(const toml::node& node) {
  ConfigNode out;
  out.line = static_cast<int>(node.source().begin.line);
  if (const auto* table = node.as_table()) convert_table(*table, out);
  if (const auto* list = node.as_array()) convert_list(*list, out);
  if (const auto* text = node.as_string()) {
    out.kind = ConfigKind::text;
    out.text = text->get();
  }
  if (const auto* truth = node.as_boolean()) {
    out.kind = ConfigKind::boolean;
    out.boolean = truth->get();
  }
  if (const auto* integer = node.as_integer()) {
    out.kind = ConfigKind::integer;
    out.integer = integer->get();
    out.number = static_cast<double>(out.integer);
  }
  if (const auto* number = node.as_floating_point()) {
    out.kind = ConfigKind::number;
    out.number = number->get();
  }
  if (const auto* date = node.as_date()) convert_date(date->get(), out);
  if (const auto* time = node.as_time()) convert_date(time->get(), out);
  if (const auto* moment = node.as_date_time()) convert_date(moment->get(), out);
  return out;
}

}  // namespace

ConfigNode parse_toml(std::string_view text) {
  try {
    return converted(toml::parse(text));
  } catch (const toml::parse_error& error) {
    const auto place = error.source().begin;
    throw InputError(static_cast<int>(place.line), "",
                     fmt::format("The file is not valid TOML at column {}: {}.", place.column,
                                 error.description()));
  }
}

std::optional<ConfigNode> parse_toml_value(std::string_view text) {
  try {
    const auto table = toml::parse("value = " + std::string(text));
    // A line break in the text could smuggle in more keys.
    if (table.size() != 1 || text.find('\n') != std::string_view::npos) return std::nullopt;
    return converted(*table.get("value"));
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

}  // namespace cdca
