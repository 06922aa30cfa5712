// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_manual.hpp"

#include "io/case_options.hpp"

#include <fmt/format.h>

namespace cdca {
namespace {

constexpr std::string_view introduction = R"(# The case file

A case file is a [TOML](https://toml.io) file. All values are in SI units; tension is positive.
This page is what `cdca options` prints: it comes from the table that checks case files.

* A *load* is a number, which is reached at load factor 1, or an expression in quotes in x, y (m) and the
  load factor s, such as `"1e6*(1 - 2*x)*s"`. Expressions know + - * / ^, the functions `sqrt`, `sin`, `cos`,
  `atan2`, `abs`, `exp`, `log` (natural), `min`, `max`, the constant `pi`, comparisons, `&&`, `||`, and
  conditionals as in `"x < 0.1 ? 1e6*s : 0"`. Without s, as in `"-5e6"`, it acts in full from the first load step:
  so a confining stress stays as it is (not with `loading.mode = "critical"`).
* Every key can be set on the command line, as in `--set material.young=70e9`. Blocks and entries of lists
  are counted from 0: `--set boundary[1].traction=[0,1e6]`, `--set crack[0].points[1][0]=0.02`.
* Unknown keys, wrong types and values outside of their range are errors; all of them are reported at once.
  What was understood, with every default, is written into the result folder as `effective.toml`.
)";

std::string default_text(const Option& option) {
  if (option.required) return "required";
  return option.standard.empty() ? "" : fmt::format("`{}`", option.standard);
}

std::string meaning(const Option& option) {
  std::string out(option.text);
  const auto others = words_of(option.excludes);
  for (std::size_t i = 0; i < others.size(); ++i) {
    out += i == 0 ? " Not with " : i + 1 == others.size() ? " or " : ", ";
    out += fmt::format("`{}`{}", others[i], i + 1 == others.size() ? "." : "");
  }
  return out;
}

std::string row(const Option& option) {
  return fmt::format("| `{}` | {} | {} | {} |\n", option.key, allowed_text(option),
                     default_text(option), meaning(option));
}

std::string heading(const OptionSection& section) {
  if (section.name.empty()) return "Top of the file";
  return fmt::format(fmt::runtime(section.repeated ? "`[[{}]]`" : "`[{}]`"), section.name);
}

std::string section_text(const OptionSection& section) {
  std::string rows;
  for (const auto* option : options_of(section.name)) {
    if (!option->whole_key_later) rows += row(*option);
  }
  return fmt::format(
      "\n## {}\n\n{}\n\n| key | allowed | default | meaning |\n| --- | --- | --- | --- |\n{}",
      heading(section), section.text, rows);
}

std::string later_text() {
  std::string out =
      "\n## Keys of later versions\n\nThis version knows these keys, and refuses case files that "
      "use them.\n\n"
      "| key | meaning |\n| --- | --- |\n";
  for (const auto& option : options()) {
    if (option.whole_key_later) out += fmt::format("| `{}` | {} |\n", option.path(), option.text);
  }
  for (const auto& section : option_sections()) {
    if (section.later) out += fmt::format("| {} | {} |\n", heading(section), section.text);
  }
  return out;
}

}  // namespace

std::string case_manual() {
  std::string out(introduction);
  for (const auto& section : option_sections()) {
    if (!section.later) out += section_text(section);
  }
  return out + later_text();
}

}  // namespace cdca
