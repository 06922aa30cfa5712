// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_effective.hpp"

#include "io/case_options.hpp"

#include <fmt/format.h>

namespace cdca {
namespace {

std::string comment_of(const Option& option) {
  return option.unit.empty() ? std::string(option.text)
                             : fmt::format("{}; {}", option.unit, option.text);
}

/// Optional keys that were not given stand there as comments, except in blocks, which may be many.
std::string lines_of(const ConfigNode& table, const OptionSection& section) {
  std::string out;
  for (const auto* option : options_of(section.name)) {
    if (option->whole_key_later) continue;
    if (const auto* value = table.find(option->key)) {
      out += fmt::format("{} = {}", option->key, toml_value(*value));
      out += section.repeated ? "\n" : fmt::format("  # {}\n", comment_of(*option));
    } else if (!section.repeated) {
      out += fmt::format("# {} is not given  # {}\n", option->key, comment_of(*option));
    }
  }
  return out;
}

}  // namespace

std::string effective_input(const ConfigNode& root) {
  std::string out = "# The case as it was understood, with every default. It can be run again.\n";
  for (const auto& section : option_sections()) {
    const auto* table = section.name.empty() ? &root : root.find(section.name);
    if (!table || section.later) continue;
    if (!section.repeated) {
      if (!section.name.empty()) out += fmt::format("\n[{}]\n", section.name);
      out += lines_of(*table, section);
      continue;
    }
    for (const auto& block : table->items)
      out += fmt::format("\n[[{}]]\n{}", section.name, lines_of(block, section));
  }
  return out;
}

}  // namespace cdca
