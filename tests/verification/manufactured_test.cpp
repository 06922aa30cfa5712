// SPDX-License-Identifier: BSD-3-Clause
/// Convergence to exact fields: M1 (near-tip field) and M2 (Westergaard) of the verification data.
#include "core/mechanics/interaction_integral.hpp"
#include "core/mechanics/williams.hpp"
#include "tests/field_errors.hpp"

#include <gtest/gtest.h>

#include <complex>

namespace cdca::testing {
namespace {

const Material material{1000.0, 0.3, true};

/// K_I and K_II of a crack y = 0, x < 0 with its tip at the origin.
ExactField near_tip_field(double k1, double k2) {
  const auto at = [=](const Vec2& x) {
    const double r = x.norm(), theta = std::atan2(x.y(), x.x());
    const auto one = williams_field(material, 1, r, theta),
               two = williams_field(material, 2, r, theta);
    return std::pair<Vec2, Eigen::Matrix2d>(k1 * one.displacement + k2 * two.displacement,
                                            k1 * one.gradient + k2 * two.gradient);
  };
  return {[at](const Vec2& x) { return at(x).first; },
          [at](const Vec2& x) { return at(x).second; }};
}

/// Westergaard's solution for a crack |x| < 1, y = 0 under biaxial remote stress 1.
ExactField westergaard() {
  using Complex = std::complex<double>;
  const auto root = [](Complex z) { return std::sqrt(z - 1.0) * std::sqrt(z + 1.0); };
  const double mu = material.shear(), nu = material.poisson;
  const auto displacement = [=](const Vec2& x) -> Vec2 {
    const Complex z(x.x(), x.y()), bar = root(z), f = z / bar;
    return Vec2((1 - 2 * nu) * bar.real() - x.y() * f.imag(),
                2 * (1 - nu) * bar.imag() - x.y() * f.real()) /
           (2 * mu);
  };
  const auto gradient = [=](const Vec2& x) {
    const Complex z(x.x(), x.y()), bar = root(z), f = z / bar, df = -1.0 / (bar * bar * bar);
    Eigen::Matrix2d g;
    g << (1 - 2 * nu) * f.real() - x.y() * df.imag(),
        -(1 - 2 * nu) * f.imag() - f.imag() - x.y() * df.real(),
        2 * (1 - nu) * f.imag() - x.y() * df.real(),
        2 * (1 - nu) * f.real() - f.real() + x.y() * df.imag();
    return Eigen::Matrix2d(g / (2 * mu));
  };
  return {displacement, gradient};
}

FieldErrors m1_errors(int n, double k1, double k2, double tip_radius) {
  const ExactField exact = near_tip_field(k1, k2);
  CaseSpec spec = plate({-1, -1}, {1, 1}, n, n);
  add_crack(spec, {{-1, 0}, {0, 0}});
  spec.tip_radius = tip_radius;
  spec.solver.tolerance = 1e-10;
  hold_rim(spec, exact.displacement);
  const Solved s = solved(spec);
  return errors_of(*s.model, exact, {Vec2(0, 0)});
}

FieldErrors m2_errors(int n, double tip_radius) {
  const ExactField exact = westergaard();
  CaseSpec spec = plate({-2, -2}, {2, 2}, n, n);
  add_crack(spec, {{-1, 0}, {1, 0}});
  spec.tip_radius = tip_radius;
  spec.solver.tolerance = 1e-10;
  hold_rim(spec, exact.displacement);
  const Solved s = solved(spec);
  return errors_of(*s.model, exact, {Vec2(-1, 0), Vec2(1, 0)});
}

double rate(double coarse, double fine, double h_ratio) {
  return std::log(coarse / fine) / std::log(h_ratio);
}

TEST(ManufacturedFields, ValuesOfTheReference) {
  // strain energy and L2 norm of M1, and a few values of M2, as tabulated
  const ExactField w = westergaard();
  EXPECT_NEAR(w.displacement({1, 0.5}).x(), 6.3253e-4, 1e-8);
  EXPECT_NEAR(w.displacement({1, 0.5}).y(), 8.1013e-4, 1e-8);
  const Voigt s = material.stress(w.gradient({0.5, 0.5}));
  EXPECT_NEAR(s[0], 0.89358393, 1e-7);
  EXPECT_NEAR(s[1], 0.24414503, 1e-7);
  EXPECT_NEAR(s[2], -0.27100317, 1e-7);
}

class NearTipRates : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(NearTipRates, FixedRadius) {
  const auto [k1, k2] = GetParam();
  const FieldErrors coarse = m1_errors(15, k1, k2, 0.4), fine = m1_errors(63, k1, k2, 0.4);
  std::cout << "K = (" << k1 << ", " << k2 << "), fixed radius: energy " << coarse.energy << " -> "
            << fine.energy << ", rate " << rate(coarse.energy, fine.energy, 63.0 / 15)
            << "; L2 rate " << rate(coarse.l2, fine.l2, 63.0 / 15) << "\n";
  EXPECT_GE(rate(coarse.energy, fine.energy, 63.0 / 15), 0.9);
  EXPECT_GE(rate(coarse.l2, fine.l2, 63.0 / 15), 1.7);
}

TEST_P(NearTipRates, TipElementOnly) {
  const auto [k1, k2] = GetParam();
  const FieldErrors coarse = m1_errors(15, k1, k2, 0.0), fine = m1_errors(63, k1, k2, 0.0);
  std::cout << "K = (" << k1 << ", " << k2 << "), tip element: energy " << coarse.energy << " -> "
            << fine.energy << ", rate " << rate(coarse.energy, fine.energy, 63.0 / 15)
            << "; L2 rate " << rate(coarse.l2, fine.l2, 63.0 / 15) << "\n";
  EXPECT_GE(rate(coarse.energy, fine.energy, 63.0 / 15), 0.45);
  EXPECT_LE(rate(coarse.energy, fine.energy, 63.0 / 15), 0.7);
  EXPECT_GE(rate(coarse.l2, fine.l2, 63.0 / 15), 0.9);
}

INSTANTIATE_TEST_SUITE_P(M1, NearTipRates,
                         ::testing::Values(std::pair(1.0, 0.0), std::pair(0.0, 1.0),
                                           std::pair(1.0, 0.5)));

TEST(WestergaardRates, FixedRadius) {
  const FieldErrors coarse = m2_errors(31, 0.4), fine = m2_errors(95, 0.4);
  const double ratio = 95.0 / 31;
  std::cout << "Westergaard, fixed radius: energy rate " << rate(coarse.energy, fine.energy, ratio)
            << ", L2 rate " << rate(coarse.l2, fine.l2, ratio) << "\n";
  EXPECT_GE(rate(coarse.energy, fine.energy, ratio), 0.9);
  EXPECT_GE(rate(coarse.l2, fine.l2, ratio), 1.7);
}

TEST(WestergaardRates, TipElementOnly) {
  const FieldErrors coarse = m2_errors(31, 0.0), fine = m2_errors(95, 0.0);
  const double ratio = 95.0 / 31;
  std::cout << "Westergaard, tip element: energy rate " << rate(coarse.energy, fine.energy, ratio)
            << ", L2 rate " << rate(coarse.l2, fine.l2, ratio) << "\n";
  EXPECT_GE(rate(coarse.energy, fine.energy, ratio), 0.45);
  EXPECT_GE(rate(coarse.l2, fine.l2, ratio), 0.9);
}

TEST(WestergaardRates, StressIntensity) {
  const ExactField exact = westergaard();
  CaseSpec spec = plate({-2, -2}, {2, 2}, 81, 81);
  add_crack(spec, {{-1, 0}, {1, 0}});
  hold_rim(spec, exact.displacement);
  spec.tip_radius = 0.3;
  spec.solver.tolerance = 1e-9;
  const Solved s = solved(spec);
  const auto k = s.model->stress_intensities(1.0);
  ASSERT_EQ(k.size(), 2u);
  for (const StressIntensity& tip : k) {
    EXPECT_NEAR(tip.k1, std::sqrt(std::acos(-1.0)), 0.005 * std::sqrt(std::acos(-1.0)));
    EXPECT_NEAR(tip.k2, 0.0, 1e-3);
  }
}

}  // namespace
}  // namespace cdca::testing
