// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_match.hpp"

#include "core/base/errors.hpp"
#include "io/case_options.hpp"
#include "io/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace cdca {
namespace {

constexpr std::array<std::string_view, 4> free_sections{"", "growth", "solver", "output"};

/// Everything else of a section may change, or nothing.
bool may_change(const Option& option) {
  if (option.section == "loading") return option.key != "mode";
  return std::find(free_sections.begin(), free_sections.end(), option.section) !=
         free_sections.end();
}

/// 1 and 1.0 are the same.
bool are_same(const ConfigNode& a, const ConfigNode& b) {
  if (a.is_number() && b.is_number()) return a.number == b.number;
  if (a.kind != ConfigKind::list || b.kind != ConfigKind::list)
    return toml_value(a) == toml_value(b);
  return std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), are_same);
}

std::string value_text(const ConfigNode* value) { return value ? toml_value(*value) : "not given"; }

class Comparison {
 public:
  explicit Comparison(const std::string& origin) : origin_(origin) {}

  void blocks(const OptionSection& section, const ConfigNode* before, const ConfigNode* now) const {
    if (!section.repeated) return block(section, std::string(section.name), before, now);
    const std::size_t count = before ? before->items.size() : 0;
    const std::size_t count_now = now ? now->items.size() : 0;
    for (std::size_t i = 0; i < std::min(count, count_now); ++i)
      block(section, fmt::format("{}[{}]", section.name, i), &before->items[i], &now->items[i]);
    if (count != count_now)
      refuse(std::string(section.name), fmt::format("{} blocks", count),
             fmt::format("{} blocks", count_now));
  }

 private:
  void block(const OptionSection& section, const std::string& path, const ConfigNode* before,
             const ConfigNode* now) const {
    for (const auto* option : options_of(section.name)) {
      if (may_change(*option)) continue;
      const auto* was = before ? before->find(option->key) : nullptr;
      const auto* is = now ? now->find(option->key) : nullptr;
      if (was && is ? are_same(*was, *is) : was == is) continue;
      refuse(fmt::format("{}.{}", path, option->key), value_text(was), value_text(is));
    }
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& was,
                           const std::string& is) const {
    throw InputError(0, key,
                     fmt::format("Found {}, but {} was written with {}; allowed is the same case, "
                                 "with other load steps, growth, solver or output at most.",
                                 is, origin_, was));
  }

  const std::string& origin_;
};

}  // namespace

void require_same_case(const std::string& before, const std::string& now,
                       const std::string& origin) {
  const ConfigNode old_root = parse_toml(before), root = parse_toml(now);
  for (const auto& section : option_sections()) {
    if (section.name.empty() || section.later) continue;
    Comparison(origin).blocks(section, old_root.find(section.name), root.find(section.name));
  }
}

}  // namespace cdca
