// SPDX-License-Identifier: BSD-3-Clause
/// Every case of tests/verification/reference/cases.json and every path of paths.json whose tag is
/// handled, within the tolerance written there; one test per case, so that none is forgotten.
#include "tests/verification/reference_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace cdca::testing {
namespace {

using Runner = std::function<ReferenceResult(const ReferenceCase&)>;

/// Who runs a case, and whether it is quick enough for every test run.
struct Handler {
  Runner run;
  std::function<bool(const ReferenceCase&)> is_quick;
};

/// Cases that take longer (about two seconds) are in the slow suite.
constexpr double quick_cost = 6e6;

const std::string near_tip_group = "near-tip stress (paper 5.1)";

ReferenceGrid grid_for(const ReferenceCase& c) {
  const ReferenceGeometry g = geometry_of(c);
  ReferenceGrid grid = grid_of(g);
  if (c.json.at("group") == near_tip_group) {  // the nearest place is two elements off the tip
    constexpr double h = 0.125;
    grid.nx = int(std::lround((g.upper.x() - g.lower.x()) / h));
    grid.ny = int(std::lround((g.upper.y() - g.lower.y()) / h));
  }
  return grid;
}

ReferenceResult stress_intensity(const ReferenceCase& c) { return tip_intensities(c, grid_for(c)); }

/// Stresses (means over an element's size) ahead of the tip and on the ring r = 1 round it.
ReferenceResult near_tip_stress(const ReferenceCase& c) {
  const ReferenceGeometry g = geometry_of(c);
  const ReferenceGrid grid = grid_for(c);
  const SolvedReference s = solve_reference(g, load_of(c), grid);
  const double allowed = tolerance_of(c).stress_rel.value();
  ReferenceResult result{c.id, size_of(grid), {}, ""};
  for (const ExpectedStress& e : expected_stresses(c)) {
    const double angle = e.degrees * std::numbers::pi / 180;
    const Vec2 x = g.cracks.at(0).points.back() + e.r * Vec2(std::cos(angle), std::sin(angle));
    const Voigt stress = mean_stress(*s.model, x);
    std::ostringstream place;
    place << "r = " << e.r << ", " << e.degrees << " deg";
    const char* const names[] = {"sigma_x", "sigma_y", "sigma_xy"};
    for (int k = 0; k < e.components; ++k) {
      const double error = std::abs(stress[k] / e.stress[k] - 1);
      result.comparisons.push_back({place.str(), names[k], stress[k], e.stress[k], error, allowed});
    }
  }
  return result;
}

/// Is there a test suite, with a test whose name ends so?
bool test_exists(const std::string& suite, const std::string& ending) {
  const auto& unit = *::testing::UnitTest::GetInstance();
  for (int k = 0; k < unit.total_test_suite_count(); ++k) {
    const auto& candidate = *unit.GetTestSuite(k);
    if (candidate.name() != suite) continue;
    for (int t = 0; t < candidate.total_test_count(); ++t) {
      const std::string name = candidate.GetTestInfo(t)->name();
      if (name.size() >= ending.size() && name.substr(name.size() - ending.size()) == ending)
        return true;
    }
  }
  return false;
}

/// The case is the subject of other tests, which must exist.
Runner tested_by(const std::string& suite, const std::string& note) {
  return [=](const ReferenceCase& c) -> ReferenceResult {
    EXPECT_TRUE(test_exists(suite, "")) << "no test suite " << suite;
    return {c.id, "", {}, note};
  };
}

/// The case has a test of its own name in each of these suites.
Runner tested_by_name_in(const std::vector<std::string>& suites, const std::string& note) {
  return [=](const ReferenceCase& c) -> ReferenceResult {
    for (const std::string& suite : suites) {
      EXPECT_TRUE(test_exists(suite, "/" + test_name(c)))
          << "no test of " << c.id << " in " << suite;
    }
    return {c.id, "", {}, note};
  };
}

bool is_small(const ReferenceCase& c) { return grid_for(c).cost(geometry_of(c)) <= quick_cost; }
bool always(const ReferenceCase&) { return true; }
/// Faces that touch take some solves more, and the rim of an infinite plane as well.
bool is_small_though_touching(const ReferenceCase& c) {
  const ReferenceGrid grid = grid_for(c);
  return grid.nx * grid.ny <= (geometry_of(c).infinite ? 5e4 : 1e5);
}

/// By group where groups differ, "" for all others.
using Handlers = std::map<std::string, Handler>;

/// A tag with an entry here is handled: all of its cases are run.
const std::map<std::string, Handlers>& handlers_by_tag() {
  static const std::map<std::string, Handlers> handlers{
      {"static",
       {{"", {stress_intensity, is_small}},
        {near_tip_group, {near_tip_stress, is_small}},
        {"manufactured near-tip field",
         {tested_by("M1/NearTipRates", "rates: `manufactured_test.cpp`"), always}},
        {"manufactured Westergaard field",
         {tested_by("WestergaardRates", "rates: `manufactured_test.cpp`"), always}}}},
      {"criterion",
       {{"max hoop stress / paper eq.(19) angles",
         {tested_by_name_in({"Cases/KinkAngles"}, "angles: `growth_test.cpp`"), always}}}},
      {"growth",
       {{"",
         {tested_by_name_in({"Paths/GrowthPaths", "Paths/SlowGrowthPaths"},
                            "paths: `growth_paths_test.cpp`"),
          always}}}},
      {"contact",
       {{"", {stress_intensity, is_small_though_touching}},
        {"partially closed crack (contact detection)", {partly_closed, always}},
        {"derived numbers for paper material", {paper_numbers, always}},
        {"paths",
         {tested_by_name_in({"Paths/WingPaths", "Paths/SlowWingPaths"},
                            "paths: `wing_paths_test.cpp`"),
          always}}}},
  };
  return handlers;
}

/// What is not run yet.
const std::vector<std::string> later_tags{"mesh"};
/// What asks for nothing.
const std::vector<std::string> silent_tags{"information"};

const Handler* handler_of(const ReferenceCase& c) {
  const Handlers& handlers = handlers_by_tag().at(c.tag);
  auto it = handlers.find(c.json.at("group"));
  if (it == handlers.end()) it = handlers.find("");
  return it == handlers.end() ? nullptr : &it->second;
}

std::vector<ReferenceCase> handled(bool quick) {
  std::vector<ReferenceCase> chosen;
  for (const ReferenceCase& c : reference_cases()) {
    if (handlers_by_tag().count(c.tag) == 0) continue;
    const Handler* handler = handler_of(c);
    if ((!handler || handler->is_quick(c)) == quick) chosen.push_back(c);
  }
  return chosen;
}

void run(const ReferenceCase& c) {
  const Handler* handler = handler_of(c);
  ASSERT_NE(handler, nullptr) << "nobody runs the group " << c.json.at("group");
  const ReferenceResult result = handler->run(c);
  std::cout << log_of(result);
  write_row(result);
  ASSERT_TRUE(!result.comparisons.empty() || !result.note.empty()) << "nothing was compared";
  for (const Comparison& k : result.comparisons) {
    EXPECT_LE(k.error, k.allowed) << k.quantity << " at " << k.place << ": " << k.computed
                                  << ", reference " << k.reference;
  }
}

class Reference : public ::testing::TestWithParam<ReferenceCase> {};
TEST_P(Reference, WithinTolerance) { run(GetParam()); }

class SlowReference : public ::testing::TestWithParam<ReferenceCase> {};
TEST_P(SlowReference, WithinTolerance) { run(GetParam()); }

std::string name_of_case(const ::testing::TestParamInfo<ReferenceCase>& c) {
  return test_name(c.param);
}

INSTANTIATE_TEST_SUITE_P(Cases, Reference, ::testing::ValuesIn(handled(true)), name_of_case);
INSTANTIATE_TEST_SUITE_P(Cases, SlowReference, ::testing::ValuesIn(handled(false)), name_of_case);

TEST(ReferenceFiles, EveryTagIsHandledOrKnownToComeLater) {
  const auto is_in = [](const std::vector<std::string>& list, const std::string& tag) {
    return std::find(list.begin(), list.end(), tag) != list.end();
  };
  int now = 0;
  for (const auto& [tag, count] : reference_tags()) {
    const bool is_handled = handlers_by_tag().count(tag) > 0, is_later = is_in(later_tags, tag);
    if (is_handled) now += count;
    if (is_later) std::cout << count << " entries tagged \"" << tag << "\" are not run yet\n";
    EXPECT_EQ(is_handled + is_later + is_in(silent_tags, tag), 1) << tag;
  }
  EXPECT_EQ(std::size_t(now), handled(true).size() + handled(false).size());
}

}  // namespace
}  // namespace cdca::testing
