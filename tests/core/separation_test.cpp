// SPDX-License-Identifier: BSD-3-Clause
/// What growth leaves of a body: loose bodies, and whether its loaded boundaries are still joined.
#include "tests/plates.hpp"

#include <gtest/gtest.h>

namespace cdca::testing {
namespace {

using Polylines = std::vector<std::vector<Vec2>>;

const std::vector<Vec2> across{{0, 3.4}, {8, 4.7}};

BoundarySpec moved(Side side, double x, double y) {
  BoundarySpec b = on_side(side);
  b.displacement = constant_load(x, y);
  return b;
}

/// A square of 8 x 8 elements whose lower and upper sides are held and moved apart.
CaseSpec clamped() {
  CaseSpec spec = plate({0, 0}, {8, 8}, 8, 8);
  spec.boundaries = {moved(Side::bottom, 0, 0), moved(Side::top, 0, 1e-3)};
  return spec;
}

/// The model once the cracks have grown.
std::unique_ptr<Model> grown(const CaseSpec& spec, const Polylines& cracks) {
  auto model = built(spec);
  CrackRegistry registry;
  for (const auto& points : cracks) registry.add("", points);
  registry.resolve_initial_meetings(model->body(), model->touch_distance());
  model->lay_cracks(registry);
  return model;
}

bool joined(const CaseSpec& spec, const Polylines& cracks) {
  return grown(spec, cracks)->joins_loaded_boundaries();
}

TEST(SeparationParallel, AnUncutBodyIsJoined) { EXPECT_TRUE(joined(clamped(), {})); }

TEST(SeparationParallel, ALigamentIsEnough) {
  EXPECT_TRUE(joined(clamped(), {{{0, 3.4}, {7.9, 4.7}}}));
}

TEST(SeparationParallel, ACrackBetweenTheLoadedSidesSeparates) {
  EXPECT_FALSE(joined(clamped(), {across}));
  EXPECT_TRUE(grown(clamped(), {across})->loose_bodies().empty()) << "both halves are held";
}

TEST(SeparationParallel, ACrackAlongTheLoadDoesNot) {
  EXPECT_TRUE(joined(clamped(), {{{3.4, 0}, {4.7, 8}}}));
}

TEST(SeparationParallel, SeveralCracksSeparateTogether) {
  EXPECT_FALSE(
      joined(clamped(), {{{0, 3.4}, {4.2, 4}}, {{4.2, 4}, {5.1, 6.3}}, {{8, 5.2}, {4.5, 5}}}));
}

TEST(SeparationParallel, AFragmentOfTheRimIsNoSeparation) {
  const auto model = grown(clamped(), {{{0, 5.3}, {3.2, 4.1}}, {{0, 2.7}, {3.2, 4.1}}});
  EXPECT_TRUE(model->joins_loaded_boundaries());
  const auto loose = model->loose_bodies();
  ASSERT_EQ(loose.size(), 1u);
  const Vec2 at = model->bodies().list()[loose[0]].at;
  EXPECT_EQ(model->bodies_at({at, Vec2(0.3, 4), Vec2(6, 2)}),
            (std::vector<std::size_t>{loose[0], loose[0], 1 - loose[0]}));
}

TEST(SeparationParallel, APartWithForcesThatComesOffSeparates) {
  CaseSpec spec = clamped();
  BoundarySpec left = on_side(Side::left);
  left.traction = constant_load(-1, 0);
  spec.boundaries.push_back(left);
  EXPECT_TRUE(joined(spec, {{{0, 5.3}, {3.2, 4.1}}}));
  EXPECT_FALSE(joined(spec, {{{0, 5.3}, {3.2, 4.1}}, {{0, 2.7}, {3.2, 4.1}}}));
}

TEST(SeparationParallel, TouchingFacesJoinAndOpenOnesDoNot) {
  for (const double up : {-1e-3, 1e-3}) {
    CaseSpec spec = clamped();
    spec.boundaries[1] = moved(Side::top, 0, up);
    add_crack(spec, across);
    ContactSpec& contact = spec.cracks.back().contact;
    contact.law = ContactLaw::frictionless;
    contact.normal_stiffness = 1e6;
    auto model = built(spec);
    EXPECT_TRUE(model->joins_loaded_boundaries()) << "faces touch at the start";
    find_equilibrium(*model, *make_solver(*model), 1.0);
    EXPECT_EQ(model->joins_loaded_boundaries(), up < 0);
  }
}

/// Rounding decides whether such faces touch at all.
TEST(SeparationParallel, FacesThatExertNextToNothingHoldNoBody) {
  CaseSpec spec = clamped();
  spec.boundaries[1] = moved(Side::top, 0, -1e-3);
  add_crack(spec, {{0, 5.3}, {3.2, 4.1}});
  add_crack(spec, {{0, 2.7}, {3.2, 4.1}});
  add_crack(spec, {{5.1, 4.4}, {7.2, 4.4}});
  for (CrackSpec& crack : spec.cracks)
    crack.contact = {ContactLaw::frictionless, 1e6, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto model = built(spec);
  EXPECT_TRUE(model->loose_bodies().empty()) << "new faces hold until an equilibrium is known";
  const double pressed = 1e3, tolerance = spec.solver.tolerance;
  for (const double part : {1e6 * tolerance, tolerance}) {
    for (ContactPatch& patch : model->contact().patches())
      patch.now.normal = patch.crack == 2 ? -pressed : -part * pressed;
    EXPECT_EQ(model->loose_bodies().size(), part > tolerance ? 0u : 1u);
  }
}

}  // namespace
}  // namespace cdca::testing
