// SPDX-License-Identifier: BSD-3-Clause
/// Loads on crack faces: by superposition a pressure opens a crack as the same tension far away
/// does.
#include "core/mechanics/interaction_integral.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

namespace cdca::testing {
namespace {

std::vector<StressIntensity> intensities(const CaseSpec& spec) {
  const Solved s = solved(spec);
  return s.model->stress_intensities(1.0);
}

CaseSpec pressurised(CaseSpec spec, double pressure) {
  pull(spec, Voigt(0, 0, 0));
  BoundarySpec faces;
  faces.kind = BoundaryKind::crack;
  faces.crack = "crack1";
  faces.pressure = proportional_load(pressure);
  spec.boundaries.push_back(faces);
  return spec;
}

class PressureLikeTension : public ::testing::TestWithParam<std::vector<Vec2>> {};

TEST_P(PressureLikeTension, SameIntensities) {
  // p on the faces equals -p everywhere plus p on the rim: biaxial tension, so that any shape will
  // do
  CaseSpec spec = plate({-1, -1.2}, {1, 1.2}, 61, 73);
  add_crack(spec, GetParam());
  spec.solver.tolerance = 1e-9;
  CaseSpec tension = spec;
  pull(tension, Voigt(1.5, 1.5, 0));
  const auto far = intensities(tension), near = intensities(pressurised(spec, 1.5));
  ASSERT_EQ(far.size(), near.size());
  for (std::size_t t = 0; t < far.size(); ++t) {
    const double k = std::hypot(far[t].k1, far[t].k2);
    EXPECT_NEAR(near[t].k1, far[t].k1, 0.003 * k);
    EXPECT_NEAR(near[t].k2, far[t].k2, 0.003 * k);
  }
}

INSTANTIATE_TEST_SUITE_P(Cracks, PressureLikeTension,
                         ::testing::Values(std::vector<Vec2>{{-0.4, 0.01}, {0.4, 0.01}},
                                           std::vector<Vec2>{{0.3, 0.3}, {-0.3, -0.2}},
                                           std::vector<Vec2>{{-1, 0.02}, {-0.4, 0.05}},
                                           std::vector<Vec2>{
                                               {-0.4, 0.01}, {0.2, 0.01}, {0.25, 0.08}}));

TEST(BodyForce, ReactionsCarryTheWeight) {
  CaseSpec spec = plate({0, 0}, {2, 1}, 12, 7);
  add_crack(spec, {{0.3, 0.2}, {1.1, 0.7}});
  spec.domain.body_force = constant_load(0.5, -3);
  BoundarySpec bottom = on_side(Side::bottom);
  bottom.displacement = constant_load(0, 0);
  spec.boundaries = {bottom};
  const Solved s = solved(spec);
  EXPECT_NEAR(s.equilibrium.reactions[0].x(), -0.5 * 2, 1e-9);
  EXPECT_NEAR(s.equilibrium.reactions[0].y(), 3.0 * 2, 1e-9);
}

TEST(PointForce, ReactionsBalanceIt) {
  CaseSpec spec = plate({0, 0}, {2, 1}, 12, 7);
  add_crack(spec, {{0.3, 0.2}, {1.1, 0.7}});
  BoundarySpec bottom = on_side(Side::bottom), force = at_point({1.37, 0.81});
  bottom.displacement = constant_load(0, 0);
  force.force = constant_load(2, 7);
  spec.boundaries = {bottom, force};
  const Solved s = solved(spec);
  EXPECT_NEAR(s.equilibrium.reactions[0].x(), -2, 1e-8);
  EXPECT_NEAR(s.equilibrium.reactions[0].y(), -7, 1e-8);
}

}  // namespace
}  // namespace cdca::testing
