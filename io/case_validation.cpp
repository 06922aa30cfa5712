// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_validation.hpp"

#include "io/case_options.hpp"
#include "io/case_value_check.hpp"
#include "io/spelling.hpp"
#include "io/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cdca {
namespace {

using Problems = std::vector<Problem>;

std::string joined_path(const std::string& block, std::string_view key) {
  return block.empty() ? std::string(key) : fmt::format("{}.{}", block, key);
}

std::vector<std::string> keys_of(const OptionSection& section) {
  std::vector<std::string> keys;
  for (const auto* option : options_of(section.name)) {
    if (!option->whole_key_later) keys.emplace_back(option->key);
  }
  return keys;
}

/// Keys at the top of the file may be tables as well.
std::vector<std::string> top_names() {
  auto names = keys_of(option_sections().front());
  for (const auto& section : option_sections()) {
    if (!section.name.empty() && !section.later) names.emplace_back(section.name);
  }
  return names;
}

/// Where a key that is unknown here is at home; empty when nowhere.
std::string home_of(std::string_view key) {
  for (const auto& option : options()) {
    if (option.key == key) {
      return option.section.empty() ? "the top of the file, before the first table"
                                    : fmt::format("[{}]", option.section);
    }
  }
  return {};
}

std::string unknown_key(const OptionSection& section, const std::string& key,
                        const std::vector<std::string>& candidates) {
  const auto place =
      section.name.empty() ? "at the top of the file" : fmt::format("in [{}]", section.name);
  const auto home = home_of(key);
  auto hint = fmt::format("; allowed are {}.", quoted_words(candidates, "and"));
  if (!home.empty()) hint = fmt::format("; it belongs to {}.", home);
  return fmt::format("The key \"{}\" is unknown {}{}", key, place,
                     did_you_mean(key, candidates, hint));
}

/// Problems of a block's own keys, and what is left of it.
class BlockCheck {
 public:
  BlockCheck(ConfigNode& block, const OptionSection& section, std::string path, Problems& problems)
      : block_(block), section_(section), path_(std::move(path)), problems_(problems) {}

  void run() {
    check_keys();
    for (const auto* option : options_of(section_.name)) {
      check_excluded(*option);
      complete(*option);
    }
  }

 private:
  void check_keys() {
    for (const auto& key : std::vector<std::string>(block_.keys)) {
      if (!is_known(key)) correct(key);
    }
    for (const auto& key : std::vector<std::string>(block_.keys)) {
      const auto* option = find_option(section_.name, key);
      if (!option) continue;  // a table at the top
      const auto before = problems_.size();
      check_value(*option, *block_.find(key), joined_path(path_, key), problems_);
      if (problems_.size() == before) continue;
      block_.erase(key);
      wrong_.push_back(key);
    }
  }

  bool is_known(const std::string& key) const {
    const bool is_table = section_.name.empty() && !key.empty() && find_section(key);
    return is_table || find_option(section_.name, key);
  }

  /// Reports a key that is unknown, and goes on as if its nearest spelling had been written: one
  /// slip is one problem, and what is wrong with the value is found as well.
  void correct(const std::string& key) {
    const auto candidates = section_.name.empty() ? top_names() : keys_of(section_);
    ConfigNode value = std::move(*block_.find(key));
    block_.erase(key);
    problems_.push_back(
        problem_at(value, joined_path(path_, key), unknown_key(section_, key, candidates)));
    const auto nearest = nearest_spelling(key, candidates);
    if (!nearest.empty() && !block_.find(nearest)) block_.set(nearest, std::move(value));
  }

  /// Of keys that replace each other, one of the command line wins over one of the file.
  void check_excluded(const Option& option) {
    for (const auto& other : words_of(option.excludes)) {
      const auto* mine = block_.find(option.key);
      const auto* node = block_.find(other);
      if (!mine || !node) continue;
      if (mine->from_command_line != node->from_command_line) {
        block_.erase(mine->from_command_line ? std::string_view(other) : option.key);
        continue;
      }
      problems_.push_back(problem_at(
          *node, joined_path(path_, other),
          fmt::format("The keys \"{}\" and \"{}\" contradict each other; allowed is one of them.",
                      option.key, other)));
      return;
    }
  }

  void complete(const Option& option) {
    if (was_given(option.key)) return;
    if (option.required) {
      problems_.push_back(
          problem_at(block_, joined_path(path_, option.key),
                     fmt::format("The required key \"{}\" is missing; allowed is {}.", option.key,
                                 allowed_text(option))));
    }
    const auto others = words_of(option.excludes);
    const bool replaced =
        std::any_of(others.begin(), others.end(), [&](const auto& key) { return was_given(key); });
    if (option.standard.empty() || replaced || goes_without(option)) return;
    auto& node = block_.set(option.key, parse_toml_value(option.standard).value());
    node.line = block_.line;
    node.is_default = true;
  }

  bool goes_without(const Option& option) const {
    const auto equals = option.no_standard_if.find('=');
    if (equals == std::string_view::npos) return false;
    const auto* node = block_.find(option.no_standard_if.substr(0, equals));
    return node && node->text == option.no_standard_if.substr(equals + 1);
  }

  bool was_given(std::string_view key) const {
    return block_.find(key) || std::find(wrong_.begin(), wrong_.end(), key) != wrong_.end();
  }

  ConfigNode& block_;
  const OptionSection& section_;
  std::string path_;
  Problems& problems_;
  std::vector<std::string> wrong_;  ///< given, but taken out again
};

void check_blocks(ConfigNode& root, const OptionSection& section, Problems& problems) {
  ConfigNode* blocks = root.find(section.name);
  if (!blocks) return;
  const bool is_list = blocks->kind == ConfigKind::list;
  const bool of_tables =
      is_list && std::all_of(blocks->items.begin(), blocks->items.end(),
                             [](const auto& item) { return item.kind == ConfigKind::table; });
  if (!of_tables) {
    problems.push_back(
        problem_at(*blocks, std::string(section.name),
                   fmt::format("Found {}; allowed are blocks that begin with [[{}]].",
                               describe(*blocks), section.name)));
    root.erase(section.name);
    return;
  }
  for (std::size_t i = 0; i < blocks->items.size(); ++i) {
    BlockCheck(blocks->items[i], section, fmt::format("{}[{}]", section.name, i), problems).run();
  }
}

void check_table(ConfigNode& root, const OptionSection& section, Problems& problems) {
  ConfigNode* table = root.find(section.name);
  if (!table && section.optional) return;
  if (!table) table = &root.set(section.name, ConfigNode{});
  if (table->kind != ConfigKind::table) {
    problems.push_back(problem_at(
        *table, std::string(section.name),
        fmt::format("Found {}; allowed is one table [{}].", describe(*table), section.name)));
    // Its required keys are not missing on top of that.
    if (section.optional) return root.erase(section.name);
    *table = ConfigNode{};
    return;
  }
  BlockCheck(*table, section, std::string(section.name), problems).run();
}

void refuse_later(ConfigNode& root, const OptionSection& section, Problems& problems) {
  const ConfigNode* node = root.find(section.name);
  if (!node) return;
  problems.push_back(problem_at(*node, std::string(section.name), later_sentence("table")));
  root.erase(section.name);
}

}  // namespace

void validate_case(ConfigNode& root, std::vector<Problem>& problems) {
  for (const auto& section : option_sections()) {
    if (section.later) {
      refuse_later(root, section, problems);
    } else if (section.name.empty()) {
      BlockCheck(root, section, "", problems).run();
    } else if (section.repeated) {
      check_blocks(root, section, problems);
    } else {
      check_table(root, section, problems);
    }
  }
}

}  // namespace cdca
