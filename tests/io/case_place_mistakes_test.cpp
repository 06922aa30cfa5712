// SPDX-License-Identifier: BSD-3-Clause
// Mistakes in the places of cracks, supports and loads.
#include "tests/io/case_samples.hpp"

#include <gtest/gtest.h>

namespace cdca {
namespace {

using testing::changed;
using testing::line_of;
using testing::plate;
using testing::problems_of;

/// The sample with other points for its first crack; must give one problem at the crack's points.
Problem crack_problem(const std::string& points) {
  const auto text = changed(plate, "points = [[0.0, 2.0], [0.95, 2.0]]", "points = " + points);
  const auto problems = problems_of(text);
  EXPECT_EQ(problems.size(), 1u) << testing::text_of(problems);
  if (problems.empty()) return {};
  EXPECT_EQ(problems[0].line, line_of(text, "points"));
  return problems[0];
}

bool says(const Problem& problem, const std::string& part) {
  if (problem.message.find(part) != std::string::npos) return true;
  ADD_FAILURE() << problem.message;
  return false;
}

TEST(CaseFileCrack, OutsideOfTheBody) {
  const auto problem = crack_problem("[[0.0, 2.0], [2.0001, 2.0]]");
  EXPECT_EQ(problem.key, "crack[0].points[1]");
  EXPECT_TRUE(says(problem, "\"edge\" reaches [2.0001, 2], which is 0.0001 m outside of the body"));
  EXPECT_TRUE(problems_of(changed(plate, "[[0.0, 2.0]", "[[-1e-10, 2.0]")).empty());  // rounding
  const auto by_center = problems_of(changed(plate, "length = 0.4", "length = 1.4"));
  ASSERT_EQ(by_center.size(), 1u);
  EXPECT_EQ(by_center[0].key, "crack[1].center");
}

TEST(CaseFileCrack, OfNoLength) {
  EXPECT_TRUE(says(crack_problem("[[0.5, 2.0], [0.5, 2.0]]"), "zero length"));
  EXPECT_EQ(crack_problem("[[0.5, 2.0], [0.9, 2.0], [0.9, 2.0]]").key, "crack[0].points[2]");
  const auto problems = problems_of(changed(plate, "length = 0.4", "length = 0.0"));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "crack[1].length");
}

TEST(CaseFileCrack, ThatMeetsItself) {
  EXPECT_TRUE(says(crack_problem("[[0.0, 2.0], [0.9, 2.0], [0.3, 2.0]]"), "folds back"));
  EXPECT_TRUE(says(crack_problem("[[0.2, 1.0], [1.0, 1.0], [1.0, 1.6], [0.5, 0.5]]"),
                   "crosses or touches itself"));
  EXPECT_TRUE(
      says(crack_problem("[[0.2, 1.0], [1.0, 1.0], [0.6, 1.6], [0.2, 1.0]]"), "touches itself"));
  EXPECT_TRUE(problems_of(changed(plate, "[0.95, 2.0]", "[0.9, 2.0], [0.4, 2.1]"))
                  .empty());  // a sharp kink
}

TEST(CaseFileCrack, AlongASide) {
  EXPECT_TRUE(says(crack_problem("[[0.0, 2.0], [0.0, 2.5], [0.9, 2.5]]"), "runs along a side"));
}

TEST(CaseFileCrack, GivenTwice) {
  const auto twice = [](const std::string& points) {
    return problems_of(
        changed(plate, "center = [1.5, 3.0]\nlength = 0.4\nangle = 30.0", "points = " + points));
  };
  for (const auto* points : {"[[0.0, 2.0], [0.95, 2.0]]", "[[0.95, 2.0], [0.0, 2.0]]"}) {
    const auto problems = twice(points);
    ASSERT_EQ(problems.size(), 1u) << testing::text_of(problems);
    EXPECT_TRUE(says(problems[0], "the same line as crack[0] \"edge\""));
  }
  const auto overlap = twice("[[0.9, 2.0], [1.4, 2.0]]");
  ASSERT_EQ(overlap.size(), 1u);
  EXPECT_EQ(overlap[0].key, "crack[1].points[0]");
  EXPECT_TRUE(says(overlap[0], "along a part of crack[0]"));
  EXPECT_TRUE(twice("[[0.95, 2.0], [1.4, 2.0]]").empty());  // end to end
  EXPECT_TRUE(twice("[[0.5, 1.5], [0.5, 2.5]]").empty());   // a crossing
}

TEST(CaseFileCrack, WithADoubledName) {
  const auto problems = problems_of(changed(plate, "name = \"edge\"", "name = \"crack2\""));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "crack[1].name");
  EXPECT_TRUE(says(problems[0], "is that of crack[0] too"));
}

TEST(CaseFileCrack, WithHalfAPlace) {
  const auto text = changed(plate, "angle = 30.0\n", "");
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "crack[1]");
  EXPECT_TRUE(says(problems[0], "all of center, length and angle"));
}

/// The sample with its block on top changed; must give one problem.
Problem boundary_problem(const std::string& block) {
  const auto problems = problems_of(changed(plate, "on = \"top\"\ntraction = [0.0, 1e6]", block));
  EXPECT_EQ(problems.size(), 1u) << testing::text_of(problems);
  return problems.empty() ? Problem{} : problems[0];
}

TEST(CaseFileBoundary, NeedsOnePlace) {
  EXPECT_TRUE(says(boundary_problem("traction = [0.0, 1e6]"), "The place is missing"));
  EXPECT_TRUE(says(boundary_problem("on = \"top\"\nat = [0, 4]\ndisplacement = [0, 1]"),
                   "contradict each other"));
  EXPECT_TRUE(
      says(boundary_problem("on = \"tpo\"\ntraction = [0.0, 1e6]"), "did you mean \"top\"?"));
  EXPECT_TRUE(
      says(boundary_problem("on = \"north\"\ntraction = [0.0, 1e6]"), "allowed are \"left\""));
  EXPECT_TRUE(says(boundary_problem("at = [0.0, 4.1]\nforce = [0.0, 1e6]"), "outside of the body"));
}

TEST(CaseFileBoundary, NeedsACrackThatIsThere) {
  const auto near = boundary_problem("on = \"crack:egde\"\npressure = 1e6");
  EXPECT_EQ(near.key, "boundary[2].on");
  EXPECT_TRUE(says(near, "There is no crack \"egde\"; did you mean \"edge\"?"));
  EXPECT_TRUE(says(boundary_problem("on = \"crack:x\"\npressure = 1e6"),
                   "the cracks are \"edge\" and \"crack2\""));
}

TEST(CaseFileBoundary, TakesTheKeysOfItsPlace) {
  const auto problem = boundary_problem("on = \"top\"\nforce = [0.0, 1e6]");
  EXPECT_EQ(problem.key, "boundary[2].force");
  EXPECT_TRUE(says(
      problem,
      "does not go with a block on a side; allowed there are \"displacement\" and \"traction\"."));
  EXPECT_TRUE(says(boundary_problem("at = [0, 4]\ntraction = [0.0, 1e6]"), "at a point"));
  EXPECT_TRUE(says(boundary_problem("on = \"crack:edge\"\ntraction = [0.0, 1e6]"),
                   "allowed there is \"pressure\""));
  EXPECT_TRUE(says(boundary_problem("on = \"top\"\npressure = 1e6"), "on a side"));
}

TEST(CaseFileBoundary, MustDoSomething) {
  EXPECT_TRUE(says(boundary_problem("on = \"top\""), "The block does nothing"));
  EXPECT_TRUE(
      says(boundary_problem("on = \"top\"\ndisplacement = [\"free\", \"free\"]"), "does nothing"));
  EXPECT_TRUE(
      problems_of(plate, {"boundary[2].traction=[0, 0]"}).empty());  // somebody studies loads
}

TEST(CaseFileBoundary, SaysEveryComponentOnce) {
  const auto loaded = boundary_problem("on = \"bottom\"\ntraction = [0.0, 1e6]");
  EXPECT_EQ(loaded.key, "boundary[2].traction[1]");
  EXPECT_TRUE(says(loaded, "boundary[0] gives its displacement in y already"));
  EXPECT_TRUE(
      says(boundary_problem("on = \"bottom\"\ndisplacement = [0.0, 1e-3]"), "displacement in y"));
  EXPECT_TRUE(says(boundary_problem("at = [0.01, 0.02]\ndisplacement = [1e-3, \"free\"]"),
                   "the node next to [0, 0]"));
  EXPECT_TRUE(problems_of(changed(plate, "on = \"top\"",
                                  "on = \"bottom\"\ndisplacement = [0.0, \"free\"]\n"
                                  "[[boundary]]\non = \"top\""))
                  .empty());
}

TEST(CaseFileBoundary, TellsWhatIsWrongInExpressions) {
  const auto open = boundary_problem("on = \"top\"\ntraction = [0.0, \"1e6*(x\"]");
  EXPECT_EQ(open.key, "boundary[2].traction[1]");
  EXPECT_TRUE(says(open, "\"1e6*(x\" cannot be read at character 7: a bracket is left open"));
  const auto infinite = boundary_problem("on = \"top\"\ntraction = [0.0, \"log(0*x)*s\"]");
  EXPECT_TRUE(says(infinite, "a finite number is needed"));
  EXPECT_TRUE(
      says(boundary_problem("on = \"top\"\ndisplacement = [\"fre\", 0.0]"), "\"fre\" is unknown"));
}

/// The sample with other supports at the bottom and at the corner.
std::string free_motions(const std::string& bottom, const std::string& corner) {
  auto text = changed(plate, "displacement = [\"free\", 0.0]", bottom);
  text = changed(text, "at = [0.0, 0.0]\ndisplacement = [0.0, \"free\"]", corner);
  const auto problems = problems_of(text);
  if (problems.empty()) return "held";
  EXPECT_EQ(problems.size(), 1u) << testing::text_of(problems);
  EXPECT_EQ(problems[0].key, "boundary");
  EXPECT_EQ(problems[0].line, line_of(text, "[[boundary]]"));
  const auto& message = problems[0].message;
  const std::string start = "The supports leave the body free in ";
  return message.substr(start.size(), message.find(';') - start.size());
}

TEST(CaseFileSupports, MustHoldTheBody) {
  const std::string load = "traction = [0.0, 1.0]";
  EXPECT_EQ(free_motions("displacement = [0.0, 0.0]", "at = [1, 1]\nforce = [1, 0]"), "held");
  EXPECT_EQ(free_motions("displacement = [\"free\", 0.0]", "at = [1, 1]\nforce = [1, 0]"),
            "translation in x");
  EXPECT_EQ(free_motions("displacement = [0.0, \"free\"]", "at = [1, 1]\nforce = [1, 0]"),
            "translation in y and rotation");
  EXPECT_EQ(free_motions(load, "at = [0, 0]\ndisplacement = [0.0, 0.0]"), "rotation");
  EXPECT_EQ(free_motions(load, "at = [1, 1]\nforce = [1, 0]"),
            "translation in x, translation in y and rotation");
  EXPECT_EQ(free_motions(load,
                         "at = [0, 0]\ndisplacement = [0, 0]\n[[boundary]]\nat = [2, 0]\n"
                         "displacement = [0, \"free\"]"),
            "rotation");
  EXPECT_EQ(free_motions(load,
                         "at = [0, 0]\ndisplacement = [0, 0]\n[[boundary]]\nat = [2, 0]\n"
                         "displacement = [\"free\", 0]"),
            "held");
}

TEST(CaseFileSupports, MissingAltogether) {
  const auto problems = problems_of(plate.substr(0, plate.find("[[boundary]]")));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "boundary");
  EXPECT_EQ(problems[0].line, 0);
}

}  // namespace
}  // namespace cdca
