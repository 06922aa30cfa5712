// SPDX-License-Identifier: BSD-3-Clause
/// The rim that makes a small rectangle answer like an infinite plane, against exact solutions.
#include "tests/verification/reference_solve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cdca::testing {
namespace {

constexpr double pi = std::numbers::pi;

class PlaneRims : public ::testing::TestWithParam<bool> {  // plane strain?
 protected:
  Material material() const { return {1000.0, 0.3, GetParam()}; }
};

TEST_P(PlaneRims, FarFieldOfAGriffithCrack) {
  // the jump of a crack |x| < 1 under the stress (0, 1, 0.5): [u] = 4 / E' sqrt(1 - x^2) (0.5, 1)
  PlaneRim rim(material(), {0, 1, 0.5});
  std::vector<PlaneRim::Jump> jumps;
  constexpr int bits = 2000;
  for (int k = 0; k < bits; ++k) {
    const double angle = pi * (k + 0.5) / bits, ds = std::sin(angle) * pi / bits;
    const double size = 4 / material().fracture_modulus() * std::sin(angle);
    jumps.push_back({{std::cos(angle), 0}, {0, ds}, size * Vec2(0.5, 1)});
  }
  rim.set_jumps(jumps);
  const Vec2 jump = rim.displacement({0.3, 1e-2}) - rim.displacement({0.3, -1e-2});
  const Vec2 exact = 4 / material().fracture_modulus() * std::sqrt(1 - 0.09) * Vec2(0.5, 1);
  EXPECT_NEAR((jump - exact).norm(), 0.0, 0.02 * exact.norm());  // the places are not on the faces

  // ahead of the tip the stress is x / sqrt(x^2 - 1) times that far away (plus the T-stress in xx)
  const auto u = [&](double x, double y) { return rim.displacement({x, y}); };
  const double d = 1e-4;
  for (const double x : {1.5, 2.0, 4.0}) {
    Eigen::Matrix2d g;
    g.col(0) = (u(x + d, 0) - u(x - d, 0)) / (2 * d);
    g.col(1) = (u(x, d) - u(x, -d)) / (2 * d);
    const double factor = x / std::sqrt(x * x - 1);
    const Voigt s = material().stress(g);
    EXPECT_NEAR(s[0], factor - 1, 1e-5);
    EXPECT_NEAR(s[1], factor, 1e-5);
    EXPECT_NEAR(s[2], 0.5 * factor, 1e-5);
  }
}

/// K_I, K_II of a crack at 30 degrees under sigma_yy = 1, in a plate that leaves `margin` round it.
std::pair<double, double> slanted(double margin) {
  ReferenceGeometry g;
  g.infinite = true;
  const Vec2 end(std::cos(pi / 6), std::sin(pi / 6));
  g.cracks.push_back({{-end, end}, {true, true}});
  ReferenceGrid grid = grid_of(g);
  const double half = 1 + margin;  // elements lie alike in every plate
  grid.lower = {-half, -half};
  grid.upper = {half, half};
  grid.nx = grid.ny = int(std::lround(40 * half));
  const auto s = solve_reference(g, {ReferenceLoad::Kind::stress, {0, 1, 0}}, grid);
  const StressIntensity& tip = tip_at(s, end);
  return {tip.k1, tip.k2};
}

TEST(InfinitePlane, NoMatterHowSmallThePlate) {
  const auto [k1, k2] = slanted(3.0);
  EXPECT_NEAR(k1, std::sqrt(pi) * 0.75, 0.006 * std::sqrt(pi));
  EXPECT_NEAR(k2, std::sqrt(pi) * 0.25 * std::sqrt(3.0), 0.006 * std::sqrt(pi));
  for (const double margin : {0.6, 1.0, 2.0}) {
    const auto [small1, small2] = slanted(margin);
    std::cout << "margin " << margin << ": K_I " << small1 << ", K_II " << small2
              << "; margin 3: K_I " << k1 << ", K_II " << k2 << "\n";
    EXPECT_NEAR(small1, k1, 1e-3 * std::sqrt(pi));
    EXPECT_NEAR(small2, k2, 1e-3 * std::sqrt(pi));
  }
}

INSTANTIATE_TEST_SUITE_P(Planes, PlaneRims, ::testing::Bool(), [](const auto& plane) {
  return std::string(plane.param ? "strain" : "stress");
});

}  // namespace
}  // namespace cdca::testing
