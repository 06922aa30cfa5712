// SPDX-License-Identifier: BSD-3-Clause
// [contact], and its keys in [[crack]].
#include "io/case_contact.hpp"

#include "io/case_describe.hpp"
#include "tests/io/case_samples.hpp"

#include <gtest/gtest.h>

namespace cdca {
namespace {

using testing::changed;
using testing::line_of;
using testing::plate;
using testing::problems_of;

const std::string coulomb =
    "law = \"coulomb\"\nnormal_stiffness = 4e13\ntangential_stiffness = 4e11\nfriction = 0.45\n";
const std::string cohesive =
    "law = \"cohesive\"\nnormal_stiffness = 4e13\ncohesive_stiffness = 1e10\ncritical_gap = 1e-5\n";

/// The sample with a [contact] table, and with lines for its second crack.
std::string touching(const std::string& lines, const std::string& of_crack = "") {
  const auto text = changed(plate, "[solver]", "[contact]\n" + lines + "[solver]");
  return changed(text, "angle = 30.0\n", "angle = 30.0\n" + of_crack);
}

CaseSpec read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    return read_case_text(text, "plate.toml", overrides);
  } catch (const InputError& error) {
    ADD_FAILURE() << testing::text_of(error.problems());
    throw;
  }
}

void expect_contact(const ContactSpec& found, const ContactSpec& expected) {
  EXPECT_EQ(found.law, expected.law);
  EXPECT_EQ(found.normal_stiffness, expected.normal_stiffness);
  EXPECT_EQ(found.tangential_stiffness, expected.tangential_stiffness);
  EXPECT_EQ(found.friction, expected.friction);
  EXPECT_EQ(found.cohesion, expected.cohesion);
  EXPECT_EQ(found.cohesive_stiffness, expected.cohesive_stiffness);
  EXPECT_EQ(found.critical_gap, expected.critical_gap);
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

TEST(CaseContact, IsNoneWithoutATable) {
  for (const auto& crack : read(plate).cracks) expect_contact(crack.contact, {});
  for (const auto& crack : read(touching("law = \"none\"\n")).cracks)
    expect_contact(crack.contact, {});
}

TEST(CaseContact, GivesEveryCrackTheCommonLaw) {
  const ContactSpec rubbing{ContactLaw::coulomb, 4e13, 4e11, 0.45, 1e4, 0.0, 0.0};
  const auto spec = read(touching(coulomb + "cohesion = 1e4\n"));
  ASSERT_EQ(spec.cracks.size(), 2u);
  for (const auto& crack : spec.cracks) expect_contact(crack.contact, rubbing);
  const ContactSpec pushing{ContactLaw::frictionless, 4e13, 0.0, 0.0, 0.0, 0.0, 0.0};
  expect_contact(
      read(touching("law = \"frictionless\"\nnormal_stiffness = 4e13\n")).cracks[0].contact,
      pushing);
  const ContactSpec glued{ContactLaw::cohesive, 4e13, 4e11, 0.3, 0.0, 1e10, 1e-5};
  expect_contact(
      read(touching(cohesive + "tangential_stiffness = 4e11\nfriction = 0.3\n")).cracks[1].contact,
      glued);
}

TEST(CaseContact, OfACrackWinsOverTheCommonOne) {
  const auto spec = read(touching(coulomb, "friction = 0.1\ncohesion = 5.0\n"));
  EXPECT_EQ(spec.cracks[0].contact.friction, 0.45);
  const ContactSpec own{ContactLaw::coulomb, 4e13, 4e11, 0.1, 5.0, 0.0, 0.0};
  expect_contact(spec.cracks[1].contact, own);
  const auto open = read(touching(coulomb, "law = \"none\"\n"));
  EXPECT_EQ(open.cracks[1].contact.law, ContactLaw::none);
  const auto alone = read(touching("", "law = \"frictionless\"\nnormal_stiffness = 1e12\n")).cracks;
  EXPECT_EQ(alone[0].contact.law, ContactLaw::none);
  EXPECT_EQ(alone[1].contact.law, ContactLaw::frictionless);
  EXPECT_EQ(alone[1].contact.normal_stiffness, 1e12);
}

TEST(CaseContact, HoldsForRandomCracks) {
  const auto text = changed(touching(coulomb, "friction = 0.1\n"), "[solver]",
                            "[crack_field]\ncount = 3\nlength = [0.1, 0.3]\n[solver]");
  const auto cracks = read(text).cracks;
  ASSERT_EQ(cracks.size(), 5u);
  const ContactSpec rubbing{ContactLaw::coulomb, 4e13, 4e11, 0.45, 0.0, 0.0, 0.0};
  for (std::size_t i = 2; i < 5; ++i) expect_contact(cracks[i].contact, rubbing);
}

TEST(CaseContact, IsWrittenAsItWasUnderstood) {
  const auto first = read(touching(cohesive,
                                   "law = \"coulomb\"\nfriction = 0.1\n"
                                   "tangential_stiffness = 1e11\n"));
  const auto again = read(first.effective);
  EXPECT_EQ(again.effective, first.effective);
  for (std::size_t i = 0; i < 2; ++i)
    expect_contact(again.cracks[i].contact, first.cracks[i].contact);
}

/// One law can be tried after the other without a change of the file.
TEST(CaseContact, CanBeSwitchedByTheCommandLine) {
  const auto text = touching(coulomb, "friction = 0.1\n");
  for (const auto& crack : read(text, {"contact.law=none"}).cracks)
    EXPECT_EQ(crack.contact.law, ContactLaw::none);
  EXPECT_EQ(read(text, {"contact.law=frictionless"}).cracks[1].contact.law,
            ContactLaw::frictionless);
  EXPECT_EQ(read(text, {"crack[1].law=none"}).cracks[0].contact.law, ContactLaw::coulomb);
  EXPECT_EQ(read(text, {"crack[1].friction=0.7"}).cracks[1].contact.friction, 0.7);
}

TEST(CaseContactMistakes, ALawNeedsItsNumbers) {
  const auto lacks = [](const std::string& lines, const std::string& line, const std::string& law,
                        const std::string& key) {
    expect_problem(touching(changed(lines, line, "")), "law =", "contact.law",
                   "The law \"" + law + "\" needs " + key + ", which is not given; allowed are");
  };
  lacks("law = \"frictionless\"\n#\n", "#\n", "frictionless", "normal_stiffness");
  lacks(coulomb, "normal_stiffness = 4e13\n", "coulomb", "normal_stiffness");
  lacks(coulomb, "tangential_stiffness = 4e11\n", "coulomb", "tangential_stiffness");
  lacks(coulomb, "friction = 0.45\n", "coulomb", "friction");
  lacks(cohesive, "normal_stiffness = 4e13\n", "cohesive", "normal_stiffness");
  lacks(cohesive, "cohesive_stiffness = 1e10\n", "cohesive", "cohesive_stiffness");
  lacks(cohesive, "critical_gap = 1e-5\n", "cohesive", "critical_gap");
  expect_problem(touching(cohesive + "friction = 0.3\n"), "law =", "contact.law",
                 "The law \"cohesive\" with friction needs tangential_stiffness");
  EXPECT_EQ(problems_of(touching("law = \"coulomb\"\n")).size(), 3u);
}

TEST(CaseContactMistakes, ACrackNeedsTheNumbersOfItsLaw) {
  expect_problem(touching("law = \"frictionless\"\nnormal_stiffness = 1e12\n",
                          "tangential_stiffness = 1e11\nlaw = \"coulomb\" # own\n"),
                 "# own", "crack[1].law", "The law \"coulomb\" needs friction");
  // every crack has what [contact] lacks
  const auto text = changed(touching(changed(coulomb, "friction = 0.45\n", ""), "friction = 0.1\n"),
                            "name = \"edge\"", "name = \"edge\"\nfriction = 0.2");
  EXPECT_EQ(read(text).cracks[0].contact.friction, 0.2);
  // but random cracks have not
  expect_problem(
      changed(text, "[solver]", "[crack_field]\ncount = 3\nlength = [0.1, 0.3]\n[solver]"),
      "law =", "contact.law", "The law \"coulomb\" needs friction");
}

TEST(CaseContactMistakes, AreToldOnce) {
  expect_problem(touching(changed(coulomb, "friction = 0.45", "friction = -1 # less")), "# less",
                 "contact.friction", "Found -1; allowed is a number, at least 0.");
  expect_problem(touching(changed(coulomb, "4e13", "0")), "normal_stiffness",
                 "contact.normal_stiffness", "greater than 0");
  expect_problem(touching(changed(coulomb, "\"coulomb\"", "\"colomb\"")), "law =", "contact.law",
                 "did you mean \"coulomb\"?");
  expect_problem(touching("", "friction = 0.1\nlaw = \"colomb\"\n"), "law =", "crack[1].law",
                 "did you mean \"coulomb\"?");
  expect_problem(touching(changed(coulomb, "friction", "frictoin")), "frictoin", "contact.frictoin",
                 "did you mean \"friction\"?");
  expect_problem(touching(cohesive, "critical_gap = 0.0 # none\n"), "# none",
                 "crack[1].critical_gap", "a number in m, greater than 0");
}

TEST(CaseContactMistakes, NumbersWithoutALawAreNotSilentlyIgnored) {
  expect_problem(touching("friction = 0.4\n"), "friction", "contact.friction",
                 "has no effect, as no law of the crack faces is given; allowed is a law with it, "
                 "\"frictionless\", \"coulomb\" or \"cohesive\".");
  expect_problem(touching("", "friction = 0.4\n"), "friction", "crack[1].friction",
                 "has no effect");
  EXPECT_TRUE(
      problems_of(touching("normal_stiffness = 1e12\n", "law = \"frictionless\"\n")).empty());
}

TEST(CaseFileDescription, NamesTheLawsOfCrackFaces) {
  const CaseSize size{800, 861, 1800, 3, 2'500'000};
  const std::string rubbing =
      "coulomb, normal stiffness 4e+13 Pa/m, tangential stiffness 4e+11 Pa/m, friction 0.45";
  EXPECT_NE(describe_case(read(plate), size).find("contact     none\n"), std::string::npos);
  EXPECT_NE(describe_case(read(touching(coulomb)), size).find("contact     " + rubbing + "\n"),
            std::string::npos);
  const auto two = describe_case(
      read(touching(coulomb,
                    "law = \"cohesive\"\ncohesive_stiffness = 1e10\ncritical_gap = 1e-5\n"
                    "friction = 0.0\n")),
      size);
  EXPECT_NE(two.find("contact     " + rubbing + ": edge\n"), std::string::npos) << two;
  EXPECT_NE(
      two.find("            cohesive, normal stiffness 4e+13 Pa/m, tangential stiffness 4e+11 "
               "Pa/m, cohesive stiffness 1e+10 Pa/m, critical gap 1e-05 m: crack2\n"),
      std::string::npos)
      << two;
}

}  // namespace
}  // namespace cdca
