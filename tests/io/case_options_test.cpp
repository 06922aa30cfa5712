// SPDX-License-Identifier: BSD-3-Clause
// The table of options, and what is made from it.
#include "io/case_options.hpp"

#include "io/case_manual.hpp"
#include "io/case_value_check.hpp"
#include "io/spelling.hpp"
#include "io/toml_reader.hpp"
#include "tests/io/case_samples.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

namespace cdca {
namespace {

using testing::changed;
using testing::plate;
using testing::problems_of;

TEST(CaseOptions, DeclareEveryKeyOnceAndInASection) {
  std::set<std::string> seen;
  for (const auto& option : options()) {
    EXPECT_TRUE(seen.insert(option.path()).second) << option.path();
    EXPECT_NE(find_section(option.section), nullptr) << option.path();
    EXPECT_EQ(find_option(option.section, option.key), &option);
    EXPECT_TRUE(option.text.ends_with(".")) << option.path();
  }
}

TEST(CaseOptions, HaveDefaultsThatTheyAllow) {
  int defaults = 0;
  for (const auto& option : options()) {
    if (option.standard.empty()) continue;
    ++defaults;
    EXPECT_FALSE(option.required) << option.path();
    const auto value = parse_toml_value(option.standard);
    ASSERT_TRUE(value) << option.path();
    std::vector<Problem> problems;
    check_value(option, *value, option.path(), problems);
    EXPECT_TRUE(problems.empty()) << testing::text_of(problems);
  }
  EXPECT_GT(defaults, 10);
}

TEST(CaseOptions, HaveWordsForChoicesAndOnlyForThem) {
  for (const auto& option : options()) {
    const bool is_choice = option.kind == OptionKind::choice;
    EXPECT_EQ(is_choice, !option.choices.empty()) << option.path();
    for (const auto& key : words_of(option.excludes))
      EXPECT_NE(find_option(option.section, key), nullptr) << key;
    const auto condition = option.no_standard_if;
    if (condition.empty()) continue;
    const auto* other = find_option(option.section, condition.substr(0, condition.find('=')));
    ASSERT_NE(other, nullptr) << condition;
    const auto words = words_of(other->choices);
    const std::string word(condition.substr(condition.find('=') + 1));
    EXPECT_NE(std::find(words.begin(), words.end(), word), words.end()) << condition;
  }
}

/// A value that an option does not take, whatever it is.
TEST(CaseOptions, RefuseTablesAndEmptyTexts) {
  for (const auto& option : options()) {
    for (const auto* text : {"{}", "\"\"", "[]", "nan"}) {
      std::vector<Problem> problems;
      check_value(option, parse_toml_value(text).value(), option.path(), problems);
      EXPECT_FALSE(problems.empty()) << option.path() << " = " << text;
    }
  }
}

TEST(CaseOptions, OfLaterVersionsAreRefusedEverywhere) {
  int tried = 0;
  for (const auto& option : options()) {
    if (!option.whole_key_later) continue;
    ++tried;
    const bool is_block = find_section(option.section)->repeated;
    const auto path =
        std::string(option.section) + (is_block ? "[0]." : ".") + std::string(option.key);
    const auto problems = problems_of(plate, {path + "=1"});
    ASSERT_EQ(problems.size(), 1u) << testing::text_of(problems);
    EXPECT_NE(problems[0].message.find("is known, but this version does not support it yet"),
              std::string::npos);
  }
  EXPECT_EQ(tried, 2);  // domain.mesh and material.field
}

TEST(CaseOptions, MakeTheManualInTheDocumentation) {
  std::ifstream file(std::string(CDCA_SOURCE_DIR) + "/docs/case-file.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), case_manual()) << "Write it again by: cdca options > docs/case-file.md";
}

TEST(CaseOptions, AllStandInTheManual) {
  const auto manual = case_manual();
  for (const auto& option : options()) {
    const auto name = option.whole_key_later ? option.path() : std::string(option.key);
    EXPECT_NE(manual.find("| `" + name + "` |"), std::string::npos) << name;
  }
}

/// Reading what was understood gives the same again, to the last bit.
TEST(CaseOptionsEffective, InputCanBeReadAgain) {
  auto text = changed(plate, "title = \"Plate\"", "title = \"A \\\"plate\\\"\\\\ \\n with ü\"");
  text =
      changed(text, "cells = [20, 40]",
              "cells = [20, 40]\nbody_force = [\"1e3*x*s\", 0.1]\nthickness = 0.3333333333333333");
  text = changed(text, "traction = [0.0, 1e6]", "traction = [\"x < 1 ? s : 0\", 1e-300]");
  for (const auto& overrides : std::vector<std::vector<std::string>>{
           {},
           {"loading.steps=7"},
           {"solver.method=relaxation", "solver.over_relaxation=1.7"},
           {"material.young=1e22"}}) {
    const auto first = read_case_text(text, "plate.toml", overrides);
    const auto again = read_case_text(first.effective, "other.toml");
    EXPECT_EQ(again.effective, first.effective);
    EXPECT_EQ(again.title, first.title);
    EXPECT_EQ(again.load_factors, first.load_factors);
    EXPECT_EQ(again.material.young, first.material.young);
    EXPECT_EQ(again.domain.thickness, 0.3333333333333333);
    EXPECT_EQ(again.solver.method, first.solver.method);
    EXPECT_EQ(again.solver.over_relaxation, first.solver.over_relaxation);
    ASSERT_EQ(again.cracks.size(), first.cracks.size());
    for (std::size_t i = 0; i < first.cracks.size(); ++i) {
      EXPECT_EQ(again.cracks[i].name, first.cracks[i].name);
      EXPECT_EQ(again.cracks[i].points, first.cracks[i].points);
    }
    ASSERT_EQ(again.boundaries.size(), first.boundaries.size());
    EXPECT_EQ(again.boundaries[2].traction[0]->at(0.5, 0, 0.3), 0.3);
    EXPECT_EQ(again.boundaries[2].traction[1]->at(0.5, 0, 1.0), 1e-300);
  }
}

TEST(CaseOptionsEffective, InputHasLoadFactorsInsteadOfSteps) {
  const auto spec =
      read_case_text(changed(plate, "steps = 4", "factors = [0.1, 0.7]"), "plate.toml");
  EXPECT_EQ(spec.effective.find("\nsteps"), std::string::npos);
  EXPECT_EQ(read_case_text(spec.effective, "plate.toml").load_factors, (std::vector{0.1, 0.7}));
}

TEST(CaseOptionsEffective, InputHasEveryOptionOfThisVersion) {
  const auto text = read_case_text(plate, "plate.toml").effective;
  for (const auto& option : options()) {
    const auto* section = find_section(option.section);
    if (option.whole_key_later || section->repeated || section->optional) continue;
    const auto given = fmt::format("\n{} = ", option.key);
    const auto absent = fmt::format("\n# {} is not given", option.key);
    EXPECT_TRUE(text.find(given) != std::string::npos || text.find(absent) != std::string::npos)
        << option.path();
    if (!option.standard.empty()) {
      EXPECT_NE(text.find(given), std::string::npos) << option.path();
    }
  }
}

TEST(CaseOptionsSpelling, FindsTheNearestWord) {
  const std::vector<std::string> words{"young", "poisson", "friction_angle", "toughness"};
  EXPECT_EQ(nearest_spelling("yuong", words), "young");       // swapped
  EXPECT_EQ(nearest_spelling("Poison", words), "poisson");    // lost, and a capital
  EXPECT_EQ(nearest_spelling("poissson", words), "poisson");  // doubled
  EXPECT_EQ(nearest_spelling("friction", words), "friction_angle");
  EXPECT_EQ(nearest_spelling("density", words), "");
  EXPECT_EQ(nearest_spelling("x", words), "");
}

}  // namespace
}  // namespace cdca
