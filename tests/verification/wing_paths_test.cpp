// SPDX-License-Identifier: BSD-3-Clause
/// Wings of closed flaws under compression against tests/verification/reference/paths.json: every
/// path tagged "contact", its beginning on a coarse grid in every test run, the whole length on
/// which the reference is strict in the slow suite.
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"
#include "tests/verification/path_comparison.hpp"
#include "tests/verification/reference_cases.hpp"

#include <gtest/gtest.h>

#include <regex>

namespace cdca::testing {
namespace {

/// A plate that is pressed together until the wings have their length: mm, MPa.
struct WingCase {
  CaseSpec spec;
  std::vector<Path> reference;
  double tolerance = 0.0;
  double strict = 0.0;  ///< of a wing, up to here the reference counts
  double step = 0.0;
};

/// The initial flaw is the longest segment of a grown one.
Path flaw_in(const Path& path) {
  std::size_t longest = 1;
  for (std::size_t k = 1; k < path.size(); ++k) {
    if ((path[k] - path[k - 1]).norm() > (path[longest] - path[longest - 1]).norm()) longest = k;
  }
  return {path[longest - 1], path[longest]};
}

double friction_of(const std::string& id) {
  static const std::regex form(R"(.* mu=([\d.]+).*)");
  std::smatch match;
  if (!std::regex_match(id, match, form)) throw std::runtime_error(id + " names no friction");
  return std::stod(match[1]);
}

void press(CaseSpec& spec) {
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom);
  top.traction = constant_load(0, -1);
  bottom.traction = constant_load(0, 1);
  BoundarySpec pin = at_point(spec.domain.origin), roller = pin;
  pin.displacement = constant_load(0, 0);
  roller.at += Vec2(spec.domain.size.x(), 0);
  roller.displacement[1] = proportional_load(0);
  spec.boundaries = {top, bottom, pin, roller};
}

/// The load is always the one at which the next tip grows, K_eq = 1. The grid is that of the paper,
/// or one with so much larger elements.
WingCase wing_case(const ReferenceCase& reference, double larger) {
  const bool small = reference.id.rfind("THREE", 0) == 0;  // 15 x 30 mm, otherwise 60 x 120
  const auto cells = [&](int n) { return int(std::lround(n / larger)); };
  WingCase c;
  c.spec = small ? plate({-7.5, -15}, {7.5, 15}, cells(101), cells(201))
                 : plate({-30, -60}, {30, 60}, cells(91), cells(181));
  c.tolerance = reference.json.at("path_tolerance");
  c.strict = reference.json.at("valid_wing_length");
  c.step = small ? 0.15 : 0.5;
  ContactSpec faces;
  faces.friction = friction_of(reference.id);
  faces.law = faces.friction > 0 ? ContactLaw::coulomb : ContactLaw::frictionless;
  const double side = c.spec.domain.size.x() / c.spec.domain.cells[0];
  faces.normal_stiffness = 1000 * c.spec.material.young / side;
  faces.tangential_stiffness = faces.normal_stiffness / 100;
  for (const auto& crack : reference.json.at("cracks")) {
    c.reference.emplace_back();
    for (const auto& p : crack)
      c.reference.back().emplace_back(p[0].get<double>(), p[1].get<double>());
    add_crack(c.spec, flaw_in(c.reference.back()));
    c.spec.cracks.back().contact = faces;
  }
  press(c.spec);
  c.spec.solver.tolerance = 1e-9;
  c.spec.material.toughness = 1.0;
  c.spec.growth.criterion = Criterion::hoop;
  c.spec.growth.fixed_step = c.spec.growth.step_in_metres = true;
  c.spec.growth.step_length = {c.step, c.step};
  c.spec.loading.critical = true;
  return c;
}

/// Ends the run when all wings have a length.
class WingLength final : public Observer {
 public:
  WingLength(const CaseSpec& spec, double length) : spec_(spec), length_(length) {}
  void on_step(const StepView& view) override {
    reached_ = true;
    for (std::size_t k = 0; k < spec_.cracks.size(); ++k) {
      for (const int end : {0, 1}) {
        const Path wing = grown_part(spec_.cracks[k].points, view.summary.cracks[k].points, end);
        reached_ = reached_ && length_of(wing) > length_ * (1 - 1e-9);
      }
    }
  }
  bool on_rest(const RestPoint& /*point*/) override { return reached_; }

 private:
  const CaseSpec& spec_;
  double length_;
  bool reached_ = false;
};

Summary grown(const CaseSpec& spec, double length) {
  WingLength end(spec, length);
  Observer* const observers[] = {&end};
  return run_simulation(spec, "test", world(), world_partitioner(), observers);
}

/// All first kinks are 70.5 degrees: under pure shear the hoop stress is greatest there.
void expect_first_kinks(const CaseSpec& spec, const Summary& run) {
  for (std::size_t k = 0; k < spec.cracks.size(); ++k) {
    for (const int end : {0, 1}) {
      const auto kink = first_kink(spec.cracks[k].points, run.cracks[k].points, end);
      ASSERT_TRUE(kink) << "tip " << k << ", " << end << " did not grow";
      EXPECT_NEAR(*kink, 70.53, 3.0) << "tip " << k << ", " << end;
    }
  }
}

/// The listed points up to `length` lie within the tolerance of the program's path, and the
/// program's points up to there within that of the reference.
void expect_paths(const ReferenceCase& reference, const WingCase& c, const Summary& run,
                  double length) {
  double distance = 0.0;
  for (std::size_t k = 0; k < c.reference.size(); ++k) {
    for (const int end : {0, 1}) {
      const Path wing = grown_part(c.spec.cracks[k].points, c.reference[k], end);
      ASSERT_GT(length_of(wing), length);
      const Path& path = run.cracks[k].points;
      const Path own = grown_part(c.spec.cracks[k].points, path, end);
      distance = std::max({distance, farthest(up_to(wing, length), path),
                           farthest(up_to(own, length * (1 + 1e-9)), c.reference[k])});
    }
  }
  std::cout << reference.id << ": largest distance " << distance << ", tolerance " << c.tolerance
            << ", " << run.steps.size() << " events, load factor " << run.steps.front().load_factor
            << " to " << run.steps.back().load_factor << ", " << run.status << " " << run.message
            << "\n";
  EXPECT_LE(distance, c.tolerance);
  expect_first_kinks(c.spec, run);
}

std::vector<ReferenceCase> wing_paths() {
  std::vector<ReferenceCase> paths;
  for (const ReferenceCase& c : reference_cases()) {
    if (c.tag == "contact" && c.json.at("group") == "paths") paths.push_back(c);
  }
  return paths;
}

std::string name_of_path(const ::testing::TestParamInfo<ReferenceCase>& c) {
  return test_name(c.param);
}

class SlowWingPaths : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(SlowWingPaths, FollowTheReference) {
  const WingCase c = wing_case(GetParam(), 1.0);
  const Summary run = grown(c.spec, c.strict);
  expect_paths(GetParam(), c, run, c.strict);
}

INSTANTIATE_TEST_SUITE_P(Paths, SlowWingPaths, ::testing::ValuesIn(wing_paths()), name_of_path);

/// Half the elements' size and half the step: the paths move by less than an element of the paper's
/// grid over the first 10 mm. The faces are as stiff as before.
class SlowRefinedWings : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(SlowRefinedWings, StayWhereTheyAre) {
  const WingCase rough = wing_case(GetParam(), 1.0);
  WingCase fine = wing_case(GetParam(), 0.5);
  fine.spec.growth.step_length = {rough.step / 2, rough.step / 2};
  for (std::size_t k = 0; k < fine.spec.cracks.size(); ++k)
    fine.spec.cracks[k].contact = rough.spec.cracks[k].contact;
  const double length = 10.0;  // mm
  const Summary once = grown(rough.spec, length), twice = grown(fine.spec, length);
  double distance = 0.0;
  for (std::size_t k = 0; k < once.cracks.size(); ++k) {
    for (const int end : {0, 1}) {
      const Path &flaw = rough.spec.cracks[k].points, &a = once.cracks[k].points,
                 &b = twice.cracks[k].points;
      const Path of_a = grown_part(flaw, a, end), of_b = grown_part(flaw, b, end);
      ASSERT_GT(std::min(length_of(of_a), length_of(of_b)), length * (1 - 1e-9));
      distance = std::max({distance, farthest(up_to(of_a, length * (1 + 1e-9)), b),
                           farthest(up_to(of_b, length * (1 + 1e-9)), a)});
    }
  }
  const double element = rough.spec.domain.size.x() / rough.spec.domain.cells[0];
  std::cout << GetParam().id << ": refined, the first " << length << " mm move by " << distance
            << " of " << element << "\n";
  EXPECT_LT(distance, element);
}

std::vector<ReferenceCase> paths_of_two() {
  auto paths = wing_paths();
  std::erase_if(paths, [](const ReferenceCase& c) { return c.id.rfind("THREE", 0) == 0; });
  return paths;
}

INSTANTIATE_TEST_SUITE_P(Paths, SlowRefinedWings, ::testing::ValuesIn(paths_of_two()),
                         name_of_path);

/// Larger elements, and the first two steps of every tip.
class WingPaths : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(WingPaths, BeginLikeTheReference) {
  const WingCase c = wing_case(GetParam(), 1.5);
  const Summary run = grown(c.spec, 2 * c.step);
  expect_paths(GetParam(), c, run, 2 * c.step);
}

INSTANTIATE_TEST_SUITE_P(Paths, WingPaths, ::testing::ValuesIn(wing_paths()), name_of_path);

}  // namespace
}  // namespace cdca::testing
