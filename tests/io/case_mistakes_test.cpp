// SPDX-License-Identifier: BSD-3-Clause
// Every kind of mistake in a case file: its line, its key, and what the message says.
#include "tests/io/case_samples.hpp"

#include <gtest/gtest.h>

namespace cdca {
namespace {

using testing::changed;
using testing::line_of;
using testing::plate;
using testing::problems_of;

/// One change to the sample that makes one problem.
struct Mistake {
  std::string from;
  std::string to;
  std::string at;  ///< on the line where this stands, after the change; empty: no line
  std::string key;
  std::string message;  ///< a part of it
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.to; }

class CaseFileMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(CaseFileMistake, IsToldWithLineKeyAndReason) {
  const auto& mistake = GetParam();
  const auto text = changed(plate, mistake.from, mistake.to);
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), 1u) << testing::text_of(problems);
  EXPECT_EQ(problems[0].line, mistake.at.empty() ? 0 : line_of(text, mistake.at));
  EXPECT_EQ(problems[0].key, mistake.key);
  EXPECT_NE(problems[0].message.find(mistake.message), std::string::npos) << problems[0].message;
  EXPECT_TRUE(problems[0].message.ends_with('.') || problems[0].message.ends_with('?'))
      << problems[0].message;
}

const Mistake names[] = {
    {"young", "yung", "yung", "material.yung", "unknown in [material]; did you mean \"young\"?"},
    {"young", "Young", "Young", "material.Young", "did you mean \"young\"?"},
    {"[solver]", "[slover]", "[slover]", "slover", "did you mean \"solver\"?"},
    {"tolerance = 1e-9", "tol = 1e-9", "tol", "solver.tol", "did you mean \"tolerance\"?"},
    {"[solver]\n", "[solver]\nzzz = 1\n", "zzz", "solver.zzz",
     "allowed are \"method\", \"tolerance\", \"over_relaxation\", \"max_iterations\" and "
     "\"condensed_nodes\""},
    {"title = \"Plate\"", "young = 1.0", "young = 1.0", "young", "it belongs to [material]"},
    {"name = \"edge\"", "nam = \"edge\"", "nam =", "crack[0].nam", "did you mean \"name\"?"},
    {"traction =", "tracton =", "tracton", "boundary[2].tracton", "did you mean \"traction\"?"},
};

const Mistake values[] = {
    {"young = 1e9", "young = \"stiff\"", "stiff", "material.young",
     "Found the text \"stiff\"; allowed is a number in Pa, greater than 0."},
    {"young = 1e9", "young = -1e9", "-1e9", "material.young", "greater than 0"},
    {"young = 1e9", "young = 0", "young", "material.young", "Found 0; allowed"},
    {"young = 1e9", "young = nan", "nan", "material.young",
     "Found nan; allowed are finite numbers only."},
    {"young = 1e9", "young = inf", "inf", "material.young", "finite"},
    {"young = 1e9", "young = 1979-05-27", "1979", "material.young",
     "Found the date or time 1979-05-27"},
    {"poisson = 0.3", "poisson = 0.5", "poisson", "material.poisson",
     "Found 0.5; allowed is a number, greater than -1 and less than 0.5."},
    {"poisson = 0.3", "poisson = -1.0", "poisson", "material.poisson", "greater than -1"},
    {"poisson = 0.3", "poisson = true", "poisson", "material.poisson", "Found true"},
    {"size = [2.0, 4.0]", "size = [2.0, 4.0, 1.0]", "size", "domain.size",
     "Found a list of 3 values; allowed is a pair [x, y]"},
    {"cells = [20, 40]", "cells = [20, 40.0]", "cells", "domain.cells[1]", "whole number"},
    {"cells = [20, 40]", "cells = [20,\n0]", "0]\n[material]", "domain.cells[1]", "at least 1"},
    {"cells = [20, 40]", "cells = 20", "cells", "domain.cells", "Found 20; allowed is a pair"},
    {"cells = [20, 40]", "cells = [20, 40]\nthickness = 0.0", "thickness", "domain.thickness",
     "greater than 0"},
    {"cells = [20, 40]", "cells = [20, 40]\nplane = \"strian\"", "plane", "domain.plane",
     "allowed are \"stress\" and \"strain\"; did you mean \"strain\"?"},
    {"[solver]", "[enrichment]\ntip_radius = -1\n[solver]", "tip_radius", "enrichment.tip_radius",
     "at least 0"},
    {"tolerance = 1e-9", "tolerance = 0.0", "tolerance", "solver.tolerance",
     "at least 1e-14 and at most 0.1"},
    {"tolerance = 1e-9", "method = \"relaxation\"\nover_relaxation = 2.0", "over_relaxation",
     "solver.over_relaxation", "greater than 0 and less than 2"},
    {"tolerance = 1e-9", "over_relaxation = 1.5", "over_relaxation", "solver.over_relaxation",
     "only the method \"relaxation\" has an over-relaxation"},
    {"every = 2", "every = 0", "every", "output.every", "at least 1"},
    {"every = 2", "pictures = \"yes\"", "pictures", "output.pictures", "true or false"},
    {"steps = 4", "steps = 0", "steps", "loading.steps", "at least 1"},
    {"steps = 4", "factors = []", "factors", "loading.factors", "Found a list of 0 values"},
    {"steps = 4", "factors = [0.2,\n0.2,\n1.0]", "0.2,\n1.0", "loading.factors[1]",
     "Found 0.2 after 0.2"},
    {"steps = 4", "factors = [-0.5, 1.0]", "factors", "loading.factors[0]", "at least 0"},
    {"title = \"Plate\"", "title = \"\"", "title", "title", "Found an empty text"},
    {"name = \"edge\"", "name = \"\"", "name", "crack[0].name", "Found an empty text"},
    {"name = \"edge\"", "name = \"a,b\"", "name", "crack[0].name", "without commas"},
    {"poisson = 0.3", "", "[material]", "material.poisson",
     "The required key \"poisson\" is missing"},
    {"[[boundary]]\non = \"top\"", "[[region]]\na = 1\n[[boundary]]\non = \"top\"", "[[region]]",
     "region", "known"},
    {"[solver]\ntolerance = 1e-9", "[[solver]]\ntolerance = 1e-9", "[[solver]]", "solver",
     "allowed is one table [solver]"},
};

INSTANTIATE_TEST_SUITE_P(Names, CaseFileMistake, ::testing::ValuesIn(names));
INSTANTIATE_TEST_SUITE_P(Values, CaseFileMistake, ::testing::ValuesIn(values));

const Mistake later[] = {
    {"[[crack]]", "[material.field]\nkind = \"weibull\"\n[[crack]]", "[material.field]",
     "material.field", "known"},
    {"cells = [20, 40]", "cells = [20, 40]\nmesh = \"plate.msh\"", "mesh", "domain.mesh", "known"},
};

INSTANTIATE_TEST_SUITE_P(Later, CaseFileMistake, ::testing::ValuesIn(later));

TEST(CaseFileMistakes, AreReportedTogetherInOrderOfLines) {
  auto text = changed(plate, "poisson = 0.3", "poisson = 0.7");
  text = changed(text, "size = [2.0, 4.0]", "size = [2.0, \"a\"]");
  text = changed(text, "every = 2", "evry = 2");
  text = changed(text, "traction = [0.0, 1e6]", "traction = [0.0, \"1e6*(x\"]");
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), 4u) << testing::text_of(problems);
  EXPECT_EQ(problems[0].key, "domain.size[1]");
  EXPECT_EQ(problems[1].key, "material.poisson");
  EXPECT_EQ(problems[2].key, "boundary[2].traction[1]");
  EXPECT_EQ(problems[3].key, "output.evry");
  for (std::size_t i = 1; i < problems.size(); ++i)
    EXPECT_LT(problems[i - 1].line, problems[i].line);
}

TEST(CaseFileMistakes, OfSpellingHideNoOthers) {
  const auto problems =
      problems_of(changed(plate, "[material]\nyoung = 1e9", "[materail]\nyuong = -1e9"));
  ASSERT_EQ(problems.size(), 3u) << testing::text_of(problems);
  EXPECT_EQ(problems[0].key, "materail");
  EXPECT_EQ(problems[1].key, "material.yuong");
  EXPECT_EQ(problems[2].key, "material.young");
  EXPECT_NE(problems[2].message.find("greater than 0"), std::string::npos);
  EXPECT_EQ(
      problems_of(changed(plate, "[[boundary]]\non = \"top\"", "[[boundry]]\non = \"top\"")).size(),
      1u);
}

TEST(CaseFileMistakes, WithoutALineComeLast) {
  const auto problems =
      problems_of(changed(plate, "[domain]\nsize = [2.0, 4.0]\ncells = [20, 40]\n", ""), {"foo=1"});
  ASSERT_EQ(problems.size(), 3u) << testing::text_of(problems);
  for (const auto& problem : problems) EXPECT_EQ(problem.line, 0);
  const auto mixed = problems_of(changed(plate, "every = 2", "evry = 2"), {"foo=1"});
  ASSERT_EQ(mixed.size(), 2u);
  EXPECT_EQ(mixed[0].key, "output.evry");
  EXPECT_EQ(mixed[1].key, "foo");
}

TEST(CaseFileMistakes, OfTheSyntaxNameTheLine) {
  const auto problems = problems_of("title = \"Plate\"\n[domain]\nsize = [2.0,\n");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_GE(problems[0].line, 3);
  EXPECT_NE(problems[0].message.find("not valid TOML"), std::string::npos);
  const auto doubled = problems_of(changed(plate, "poisson = 0.3", "poisson = 0.3\nyoung = 2e9"));
  ASSERT_EQ(doubled.size(), 1u);
  EXPECT_EQ(doubled[0].line, 8);
}

TEST(CaseFileMistakes, ContradictingKeysAreNamed) {
  const auto text = changed(plate, "steps = 4", "steps = 4\nfactors = [0.5, 1.0]");
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), 1u) << testing::text_of(problems);
  EXPECT_EQ(problems[0].line, line_of(text, "factors"));
  EXPECT_NE(problems[0].message.find("\"steps\" and \"factors\" contradict each other"),
            std::string::npos);
  const auto crack = problems_of(changed(plate, "name = \"edge\"", "center = [1.0, 1.0]"));
  ASSERT_EQ(crack.size(), 1u) << testing::text_of(crack);
  EXPECT_EQ(crack[0].key, "crack[0].center");
}

TEST(CaseFileMistakes, OfAMissingFileOrAFolder) {
  EXPECT_THROW(read_case("/no/such/case.toml"), InputError);
  try {
    read_case("/tmp");
    FAIL() << "a folder was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("it is a folder"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace cdca
