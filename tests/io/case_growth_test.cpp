// SPDX-License-Identifier: BSD-3-Clause
// [growth], [loading] in critical mode, and [crack_field].
#include "io/case_describe.hpp"
#include "tests/io/case_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cdca {
namespace {

using testing::changed;
using testing::line_of;
using testing::plate;
using testing::problems_of;

/// The sample with a tough material and cracks that grow.
std::string growing(const std::string& lines = "", const std::string& criterion = "hoop") {
  const auto text = changed(plate, "poisson = 0.3", "poisson = 0.3\ntoughness = 1e5");
  return changed(text, "[solver]",
                 "[growth]\ncriterion = \"" + criterion + "\"\n" + lines + "\n[solver]");
}

std::string critical(const std::string& lines = "") {
  return changed(growing(), "steps = 4", "mode = \"critical\"\n" + lines);
}

std::string scattered(const std::string& lines = "count = 5\nlength = [0.1, 0.3]") {
  return changed(plate, "[solver]", "[crack_field]\n" + lines + "\n[solver]");
}

CaseSpec read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    return read_case_text(text, "plate.toml", overrides);
  } catch (const InputError& error) {
    ADD_FAILURE() << testing::text_of(error.problems());
    throw;
  }
}

void expect_same(const GrowthSpec& a, const GrowthSpec& b) {
  EXPECT_EQ(a.criterion, b.criterion);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.full_field, b.full_field);
  EXPECT_EQ(a.literal, b.literal);
  EXPECT_EQ(a.fixed_step, b.fixed_step);
  EXPECT_EQ(a.step_length, b.step_length);
  EXPECT_EQ(a.step_in_metres, b.step_in_metres);
  EXPECT_EQ(a.corrected, b.corrected);
  EXPECT_EQ(a.cycles, b.cycles);
}

void expect_same(const std::vector<CrackSpec>& a, const std::vector<CrackSpec>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].points, b[i].points);
  }
}

/// The text must have one problem, with this key, on the line where `at` stands.
void expect_problem(const std::string& text, const std::string& at, const std::string& key,
                    const std::string& message) {
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), 1u) << testing::text_of(problems) << "\n" << text;
  EXPECT_EQ(problems[0].line, line_of(text, at)) << problems[0].message;
  EXPECT_EQ(problems[0].key, key);
  EXPECT_NE(problems[0].message.find(message), std::string::npos) << problems[0].message;
  EXPECT_TRUE(problems[0].message.ends_with('.') || problems[0].message.ends_with('?'));
}

TEST(CaseGrowth, HasTheDefaultsOfTheSimulation) {
  const auto spec = read(plate);
  expect_same(spec.growth, GrowthSpec());
  EXPECT_EQ(spec.loading.critical, LoadingSpec().critical);
  EXPECT_EQ(spec.loading.max_events, LoadingSpec().max_events);
  EXPECT_EQ(spec.loading.min_factor, LoadingSpec().min_factor);
  const auto text = growing();
  const auto hoop = read(text).growth;
  EXPECT_EQ(hoop.criterion, Criterion::hoop);
  EXPECT_EQ(hoop.line, line_of(text, "[growth]"));
}

TEST(CaseGrowth, GivesTheValuesOfTheFile) {
  const auto text =
      changed(growing("radius = 0.25\nfield = \"full\"\nliteral = true\nstep = \"fixed\"\n"
                      "step_length = 0.05\nstep_unit = \"m\"\ndirection = \"explicit\"\n"
                      "cycles = 7",
                      "mixed"),
              "toughness = 1e5", "tensile_strength = 2e5");
  const auto growth = read(text).growth;
  EXPECT_EQ(growth.criterion, Criterion::mixed);
  EXPECT_EQ(growth.radius, 0.25);
  EXPECT_TRUE(growth.full_field && growth.literal && growth.fixed_step && growth.step_in_metres);
  EXPECT_EQ(growth.step_length, (std::array{0.05, 0.05}));
  EXPECT_FALSE(growth.corrected);
  EXPECT_EQ(growth.cycles, 7);
  const auto again = read(read(text).effective);
  expect_same(again.growth, growth);
}

TEST(CaseGrowth, TakesOneLengthOrLimits) {
  EXPECT_EQ(read(growing("step_length = 2")).growth.step_length, (std::array{2.0, 2.0}));
  EXPECT_EQ(read(growing("step_length = [1, 2.5]")).growth.step_length, (std::array{1.0, 2.5}));
  const auto fixed = read(growing("step = \"fixed\"\nstep_length = [3, 3]"));
  EXPECT_EQ(fixed.growth.step_length, (std::array{3.0, 3.0}));
  EXPECT_EQ(read(fixed.effective).growth.step_length, (std::array{3.0, 3.0}));
}

TEST(CaseGrowth, TellsMistakes) {
  const auto wrong = [](const std::string& line, const std::string& key,
                        const std::string& message) {
    expect_problem(growing(line), line, "growth." + key, message);
  };
  wrong("radius = \"big\"", "radius", "allowed is \"auto\" or a number in m, greater than 0.");
  wrong("radius = 0.0", "radius", "greater than 0");
  wrong("field = \"ful\"", "field", "did you mean \"full\"?");
  wrong("literal = 1", "literal", "true or false");
  wrong("step = \"arest\"", "step", "did you mean \"arrest\"?");
  wrong("step_length = 0", "step_length", "greater than 0, or a pair [low, high]");
  wrong("step_length = \"auto\"", "step_length", "Found the text \"auto\"");
  wrong("step_length = [1, 2, 3]", "step_length", "Found a list of 3 values");
  wrong("step_length = [0, 2]", "step_length[0]", "greater than 0");
  wrong("step_length = 0.009", "step_length", "steps of at least 0.01 elements");
  wrong("step_length = [3, 2]", "step_length", "Found [3, 2]; allowed are limits [low, high]");
  wrong("step_unit = \"mm\"", "step_unit", "\"element\" and \"m\"");
  wrong("direction = \"free\"", "direction", "\"corrected\" and \"explicit\"");
  wrong("cycles = 0", "cycles", "at least 1");
  wrong("cyles = 3", "cyles", "did you mean \"cycles\"?");
  expect_problem(growing("step = \"fixed\"\nstep_length = [1, 2]"), "step_length",
                 "growth.step_length", "allowed is one number");
  expect_problem(growing("step = \"fixed\""), "[growth]", "growth.step_length",
                 "step_length is [1.0, 4.0]; allowed is one number");
  expect_problem(growing("step_unit = \"m\"\nstep_length = [5, 6]"), "step_length",
                 "growth.step_length", "longer than the body");
  expect_problem(growing("step_unit = \"m\"\nstep_length = [0.0009, 6]"), "step_length",
                 "growth.step_length", "steps of at least 0.001 m");
}

TEST(CaseGrowth, NeedsAMaterialForItsCriterion) {
  expect_problem(changed(growing(), "toughness = 1e5\n", ""), "criterion", "growth.criterion",
                 "The criterion \"hoop\" needs material.toughness");
  expect_problem(growing("", "mixed"), "criterion", "growth.criterion",
                 "The criterion \"mixed\" needs material.tensile_strength");
  expect_problem(changed(growing(), "toughness = 1e5", "toughness = -1"), "toughness",
                 "material.toughness", "greater than 0");
  expect_problem(growing("", "hop"), "criterion", "growth.criterion", "did you mean \"hoop\"?");
}

TEST(CaseLoading, FindsTheFactorsInCriticalMode) {
  const auto spec = read(critical("max_events = 5\nmin_factor = 0.2"));
  EXPECT_TRUE(spec.loading.critical);
  EXPECT_EQ(spec.loading.max_events, 5);
  EXPECT_EQ(spec.loading.min_factor, 0.2);
  EXPECT_EQ(spec.effective.find("\nsteps = "), std::string::npos);
  const auto again = read(spec.effective);
  EXPECT_EQ(again.effective, spec.effective);
  EXPECT_TRUE(again.loading.critical);
  EXPECT_EQ(again.loading.max_events, 5);
  EXPECT_EQ(again.loading.min_factor, 0.2);
}

TEST(CaseLoading, TellsMistakes) {
  expect_problem(critical("steps = 4"), "steps", "loading.steps", "contradicts the mode");
  expect_problem(critical("factors = [0.5, 1.0]"), "factors", "loading.factors",
                 "contradicts the mode");
  expect_problem(critical("max_events = 0"), "max_events", "loading.max_events", "at least 1");
  for (const auto* line : {"min_factor = 0.0", "min_factor = 1.0"}) {
    expect_problem(critical(line), line, "loading.min_factor", "greater than 0 and less than 1");
  }
  expect_problem(changed(plate, "steps = 4", "mode = \"critical\""), "mode", "loading.mode",
                 "growth.criterion is \"none\"");
  expect_problem(changed(critical(), "\"critical\"", "\"crytical\""), "mode", "loading.mode",
                 "did you mean \"critical\"?");
}

TEST(CaseLoading, NeedsProportionalLoadsInCriticalMode) {
  const auto loaded = [](const std::string& value) {
    return changed(critical(), "traction = [0.0, 1e6]", "traction = [0.0, " + value + "]");
  };
  EXPECT_TRUE(problems_of(loaded("\"1e6*x*s\"")).empty());
  expect_problem(loaded("\"1e6*x\""), "traction", "boundary[2].traction[1]",
                 "not proportional to the load factor");
  expect_problem(loaded("\"1e6*s^2\""), "traction", "boundary[2].traction[1]", "not proportional");
  expect_problem(changed(critical(), "[\"free\", 0.0]", "[\"free\", \"1e-3*x\"]"), "\"1e-3*x\"",
                 "boundary[0].displacement[1]", "not proportional");
  expect_problem(changed(critical(), "cells", "body_force = [0, \"1 + s\"]\ncells"), "body_force",
                 "domain.body_force[1]", "not proportional");
}

TEST(CaseCrackField, IsTheSameForTheSameSeed) {
  const auto first = read(scattered());
  ASSERT_EQ(first.cracks.size(), 7u);
  EXPECT_EQ(first.cracks[0].name, "edge");
  EXPECT_EQ(first.cracks[2].name, "random1");
  EXPECT_EQ(first.cracks[6].name, "random5");
  EXPECT_EQ(first.cracks[2].line, line_of(scattered(), "[crack_field]"));
  for (std::size_t i = 2; i < 7; ++i) {
    EXPECT_GE(length_of(first.cracks[i]), 0.1 - 1e-12);
    EXPECT_LE(length_of(first.cracks[i]), 0.3 + 1e-12);
  }
  expect_same(read(scattered()).cracks, first.cracks);
  expect_same(read(scattered(), {"crack_field.seed=0"}).cracks, first.cracks);
  EXPECT_NE(read(scattered(), {"crack_field.seed=1"}).cracks[2].points, first.cracks[2].points);
}

TEST(CaseCrackField, StaysInItsRegion) {
  const auto spec =
      read(scattered("count = 50\nlength = [0.1, 0.2]\nangle = [30, 30]\n"
                     "region = [0.5, 1.0, 1.5, 2.0]\nseed = 3"));
  ASSERT_EQ(spec.cracks.size(), 52u);
  for (std::size_t i = 2; i < spec.cracks.size(); ++i) {
    const auto& points = spec.cracks[i].points;
    for (const auto& at : points) {
      EXPECT_TRUE(at.x() >= 0.5 && at.x() <= 1.5 && at.y() >= 1.0 && at.y() <= 2.0);
    }
    const Vec2 along = points[1] - points[0];
    EXPECT_NEAR(along.y() / along.x(), 1.0 / std::sqrt(3.0), 1e-9);
  }
}

TEST(CaseCrackField, IsWrittenAsItsKeys) {
  const auto first = read(scattered());
  EXPECT_NE(first.effective.find("[crack_field]\ncount = 5"), std::string::npos);
  EXPECT_NE(first.effective.find("\n# region is not given"), std::string::npos);
  EXPECT_EQ(first.effective.find("random1\""), std::string::npos);
  const auto again = read(first.effective);
  EXPECT_EQ(again.effective, first.effective);
  expect_same(again.cracks, first.cracks);
  EXPECT_EQ(read(plate).effective.find("[crack_field]"), std::string::npos);
}

TEST(CaseCrackField, CanBeTheOnlyCracksAndBeLoaded) {
  auto text = plate.substr(0, plate.find("[[crack]]")) + plate.substr(plate.find("[[boundary]]"));
  text = changed(text, "[solver]", "[crack_field]\ncount = 2\nlength = [0.1, 0.3]\n[solver]");
  text =
      changed(text, "[loading]", "[[boundary]]\non = \"crack:random2\"\npressure = 1e5\n[loading]");
  const auto spec = read(text);
  EXPECT_EQ(spec.cracks.size(), 2u);
  EXPECT_EQ(spec.boundaries[3].crack, "random2");
}

TEST(CaseCrackField, TellsMistakes) {
  const auto wrong = [](const std::string& from, const std::string& to, const std::string& at,
                        const std::string& key, const std::string& message) {
    const auto text = scattered("count = 5\nlength = [0.1, 0.3] # of a crack\nseed = 2");
    expect_problem(changed(text, from, to), at, "crack_field." + key, message);
  };
  wrong("count = 5", "count = 0", "count = 0", "count", "at least 1");
  wrong("count = 5", "count = 2.5", "count = 2.5", "count", "a whole number");
  wrong("count = 5\n", "", "[crack_field]", "count", "The required key \"count\" is missing");
  wrong("length = [0.1, 0.3]", "length = 0.1", "length = 0.1", "length", "a pair [low, high]");
  wrong("length = [0.1, 0.3]", "length = [0.3, 0.1]", "length = [0.3", "length", "low at most");
  wrong("length = [0.1, 0.3]", "length = [0.0, 0.1]", "length = [0.0", "length[0]",
        "greater than 0");
  wrong("length = [0.1, 0.3]", "length = [9, 9]", "length = [9", "length", "hardly fit");
  wrong("length = [0.1, 0.3]", "length = [4.45, 4.45]", "length = [4.4", "length", "hardly fit");
  wrong("seed = 2", "seed = -2", "seed", "seed", "at least 0");
  wrong("seed = 2", "seed = 2.0", "seed", "seed", "a whole number");
  wrong("seed = 2", "sed = 2", "sed =", "sed", "did you mean \"seed\"?");
  wrong("seed = 2", "angle = [90, 0]", "angle = [90", "angle", "low at most high");
  wrong("seed = 2", "region = [0, 0, 1]", "region", "region", "Found a list of 3 values");
  wrong("seed = 2", "region = [0, 1, 1, 1]", "region", "region", "x0 < x1 and y0 < y1");
  wrong("seed = 2", "region = [0, 0, 1, 4.1]", "region", "region", "reaches out of the body");
  const auto named = changed(scattered(), "\"edge\"", "\"random3\"");
  expect_problem(named, "random3", "crack[0].name", "is that of a crack of crack_field too");
  expect_problem(changed(scattered(), "[crack_field]", "[[crack_field]]"), "[[crack_field]]",
                 "crack_field", "allowed is one table [crack_field]");
}

TEST(CaseFileDescription, NamesGrowthAndCriticalLoading) {
  const auto text = describe_case(read(critical("max_events = 5")), {800, 861, 1800, 3, 2'500'000});
  for (const auto* part : {"at most 5 growth events, ends below 0.05 of the largest factor",
                           "hoop, arrest steps of 1 to 4 element sides, corrected directions"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
}

}  // namespace
}  // namespace cdca
