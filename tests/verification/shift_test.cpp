// SPDX-License-Identifier: BSD-3-Clause
/// K must not depend on how a crack happens to lie in the grid.
#include "core/mechanics/interaction_integral.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <numbers>

namespace cdca::testing {
namespace {

constexpr double pi = std::numbers::pi;

/// Displacement round a crack |x| < 1 under biaxial tension 1 far away, turned by `angle` and moved
/// to `centre`: any place of it in any grid has K_I = sqrt(pi) and K_II = 0.
Field westergaard_at(const Vec2& centre, double angle) {
  const double mu = 1000.0 / 2.6, nu = 0.3;
  const Eigen::Rotation2Dd turn(angle);
  return [=](const Vec2& place) -> Vec2 {
    const Vec2 x = turn.inverse() * (place - centre);
    const std::complex<double> z(x.x(), x.y());
    const auto bar = std::sqrt(z - 1.0) * std::sqrt(z + 1.0), f = z / bar;
    const Vec2 u((1 - 2 * nu) * bar.real() - x.y() * f.imag(),
                 2 * (1 - nu) * bar.imag() - x.y() * f.real());
    return turn * Vec2(u / (2 * mu));
  };
}

struct Range {
  double low = 1e300;
  double high = -1e300;
  double other = 0.0;  ///< largest |K_II|
};

/// A crack of 20 elements in n x n shifts by fractions of an element; K relative to the exact one.
Range shifted(double angle, int n) {
  constexpr int cells = 40;
  constexpr double h = 0.1;
  Range range;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec2 centre(h * i / n, h * j / n);
      const Vec2 along(std::cos(angle), std::sin(angle));
      CaseSpec spec = plate({-0.5 * cells * h, -0.5 * cells * h},
                            {0.5 * cells * h, 0.5 * cells * h}, cells, cells);
      add_crack(spec, {centre - along, centre + along});
      spec.solver.tolerance = 1e-7;
      hold_rim(spec, westergaard_at(centre, angle));
      const Solved s = solved(spec);
      const auto tips = s.model->stress_intensities(1.0);
      for (const StressIntensity& k : tips) {
        range.low = std::min(range.low, k.k1 / std::sqrt(pi));
        range.high = std::max(range.high, k.k1 / std::sqrt(pi));
        range.other = std::max(range.other, std::abs(k.k2) / std::sqrt(pi));
      }
    }
  }
  std::cout << "angle " << angle * 180 / pi << ", " << n << " x " << n << " shifts: K_I/exact "
            << range.low << " to " << range.high << ", |K_II| up to " << range.other << "\n";
  return range;
}

TEST(Shifts, AlongGridLinesAndThroughNodes) {
  const Range r = shifted(0.0, 21);
  EXPECT_LT(r.high - r.low, 0.01);
  EXPECT_NEAR(0.5 * (r.high + r.low), 1.0, 0.02);
  EXPECT_LT(r.other, 0.01);
}

class SlantedShifts : public ::testing::TestWithParam<double> {};

TEST_P(SlantedShifts, WithinOnePercent) {
  const Range r = shifted(GetParam() * pi / 180, 7);
  EXPECT_LT(r.high - r.low, 0.01);
  EXPECT_NEAR(0.5 * (r.high + r.low), 1.0, 0.02);
  EXPECT_LT(r.other, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Angles, SlantedShifts, ::testing::Values(17.0, 45.0, 90.0));

}  // namespace
}  // namespace cdca::testing
