// SPDX-License-Identifier: BSD-3-Clause
/// A bar that is cut through, with cohesive faces, pulled apart, unloaded and pulled again: Eq. 12
/// with its steep branch, solved by hand.
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cdca::testing {
namespace {

/// Uniaxial: stress and gap of the bar follow from the displacement of its top alone.
struct CohesiveBar {
  static constexpr double young = 1000.0, height = 2.0;
  static constexpr double stiffness = 100.0, critical = 0.01;  ///< k_C, g_C
  static constexpr double peak_at = 0.01 * critical;
  double largest = 0.0;  ///< gap so far

  static double envelope(double g) {
    const double peak = stiffness * (critical - peak_at);
    if (g < peak_at) return peak * g / peak_at;
    return std::max(0.0, stiffness * (critical - g));
  }
  /// Stress at the displacement u > 0 of the top: u = g + t H / E.
  double stress_at(double u) {
    const double flexibility = height / young;
    const double peak_u = peak_at + envelope(peak_at) * flexibility;
    const double turn = largest + envelope(largest) * flexibility;
    double g = u;  // separated
    if (u < turn) {
      g = u / (1 + envelope(largest) / largest * flexibility);
      return envelope(largest) / largest * g;
    }
    if (u < peak_u)
      g = u / (1 + envelope(peak_at) / peak_at * flexibility);
    else if (u < critical)
      g = (u - stiffness * critical * flexibility) / (1 - stiffness * flexibility);
    largest = g;
    return envelope(g);
  }
  static double area() { return 0.5 * envelope(peak_at) * critical; }
};

CaseSpec bar(double cut_at) {
  CaseSpec spec = plate({0, 0}, {1, CohesiveBar::height}, 4, 9);
  spec.material.poisson = 0.0;
  add_crack(spec, {{0, cut_at}, {1, cut_at}});
  ContactSpec& faces = spec.cracks.back().contact;
  faces.law = ContactLaw::cohesive;
  faces.normal_stiffness = 1e5;
  faces.tangential_stiffness = 1e3;
  faces.cohesive_stiffness = CohesiveBar::stiffness;
  faces.critical_gap = CohesiveBar::critical;
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom);
  top.displacement = constant_load(0, 1);
  bottom.displacement = constant_load(0, 0);
  spec.boundaries = {top, bottom};
  return spec;
}

class Cohesive : public ::testing::TestWithParam<double> {};

TEST_P(Cohesive, SeparationWithUnloadingFollowsTheLaw) {
  const auto model = built(bar(GetParam()));
  CohesiveBar exact;
  const double peak = CohesiveBar::envelope(CohesiveBar::peak_at);
  double worst = 0.0;
  for (const double u : {4e-4, 1e-3, 2e-3, 2.5e-3, 4e-3, 2e-3, 1e-3, 3e-3, 4.2e-3, 6e-3, 3e-3, 8e-3,
                         9.9e-3, 1.1e-2}) {
    const Equilibrium e = find_equilibrium(*model, *make_solver(*model), u);
    model->accept_contact();
    const double expected = exact.stress_at(u);
    worst = std::max(worst, std::abs(e.reactions.at(0).y() - expected) / peak);
    EXPECT_NEAR(e.reactions.at(0).y(), expected, 1e-8 * peak) << "at " << u;
  }
  std::cout << "stresses off by " << worst << " of the strength\n";
}

/// The work of the supports, with unloading on the way, is what the faces take.
TEST_P(Cohesive, WorkIsTheAreaUnderTheCurve) {
  CaseSpec spec = bar(GetParam());
  spec.load_factors.clear();
  const auto go = [&](double from, double to) {
    const int steps = int(std::lround(std::abs(to - from) / 5e-5));
    for (int k = 1; k <= steps; ++k) spec.load_factors.push_back(from + (to - from) * k / steps);
  };
  go(0, 5e-3);
  go(5e-3, 1e-3);
  go(1e-3, 1.05e-2);
  const Summary run = run_simulation(spec, "test", world(), world_partitioner(), {});
  EXPECT_EQ(run.status, "completed");
  std::cout << "work over area " << run.steps.back().external_work / CohesiveBar::area() << "\n";
  EXPECT_NEAR(run.steps.back().external_work, CohesiveBar::area(), 0.01 * CohesiveBar::area());
  EXPECT_NEAR(run.steps.back().strain_energy, 0.0, 1e-9 * CohesiveBar::area());
}

INSTANTIATE_TEST_SUITE_P(Heights, Cohesive, ::testing::Values(1.0, 1.04, 8.0 / 9));

}  // namespace
}  // namespace cdca::testing
