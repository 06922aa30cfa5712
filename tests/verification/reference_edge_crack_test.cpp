// SPDX-License-Identifier: BSD-3-Clause
/// Section 5.1 of the paper: plate 20 mm x 52 mm under 0.2 GPa, edge crack of 12 mm.
#include "tests/verification/reference_report.hpp"
#include "tests/verification/reference_solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>

namespace cdca::testing {
namespace {

constexpr double sigma = 0.2e9;  // Pa
constexpr double mm = 1e-3;

ReferenceCase near_tip_case() {
  for (const ReferenceCase& c : reference_cases()) {
    if (c.id == "NEARTIP_W_20_H_52_a_12") return c;
  }
  throw std::runtime_error("the case is gone");
}

double reference_k() { return sigma * std::sqrt(mm) * expected_tips(near_tip_case()).at(0).k1; }

/// examples/edge_crack.toml with the origin at the mouth of the crack.
CaseSpec edge_crack(int nx, int ny, double tip_radius) {
  CaseSpec spec = plate({0, -26 * mm}, {20 * mm, 26 * mm}, nx, ny);
  spec.domain.plane_strain = false;
  spec.material.young = 76e9;
  spec.material.poisson = 0.286;
  spec.tip_radius = tip_radius;
  spec.solver.tolerance = 1e-8;
  add_crack(spec, {{0, 0}, {12 * mm, 0}});
  pull(spec, {0, sigma, 0});
  return spec;
}

/// Stress over sigma at a place given in mm from the tip.
Voigt relative_stress(const Model& model, double x, double y) {
  return mean_stress(model, mm * Vec2(12 + x, y)) / sigma;
}

double two_elements(const Model& model) { return 2 * model.grid().element_size().maxCoeff() / mm; }

/// Numbers for scripts/plot_neartip.py, into the folder that CDCA_EDGE_CRACK names: K, then the
/// stresses ahead of the tip at the middles of elements and at the places of the reference.
void write_numbers(const Model& model, double k1) {
  const char* folder = std::getenv("CDCA_EDGE_CRACK");
  if (!folder || !*folder) return;
  const StructuredGrid& grid = model.grid();
  std::ostringstream name;
  name << "edge-crack-" << grid.nx() << "x" << grid.ny() << "-radius-"
       << model.spec().tip_radius / mm << ".csv";
  std::ofstream file(std::filesystem::path(folder) / name.str());
  file << "# elements " << grid.nx() << " x " << grid.ny() << "\n# element_mm "
       << two_elements(model) / 2 << "\n# tip_radius_mm " << model.spec().tip_radius / mm
       << "\n# K_I_over_sigma " << std::setprecision(6) << k1 / sigma / std::sqrt(mm)
       << "\nkind,r_mm,sigma_x,sigma_y\n";
  const auto row = [&](const char* kind, double r) {
    const Voigt s = relative_stress(model, r, 0);
    file << kind << "," << r << "," << s[0] << "," << s[1] << "\n";
  };
  for (int i = 0; i < grid.nx(); ++i) {
    const double r = grid.from_grid(Vec2(i + 0.5, 0)).x() / mm - 12;
    if (r > two_elements(model) / 4) row("element", r);
  }
  for (const ExpectedStress& e : expected_stresses(near_tip_case())) {
    if (e.degrees == 0 && e.r >= two_elements(model)) row("reference", e.r);
  }
  if (!file) throw std::runtime_error("cannot write the numbers of the edge crack");
}

/// K_I within `k_error`, stresses two elements and more from the tip within `stress_error` of the
/// length of (xx, yy, xy) there.
void check(int nx, int ny, double tip_radius, double k_error, double stress_error) {
  const CaseSpec spec = edge_crack(nx, ny, tip_radius);  // the model borrows it
  const Solved s = solved(spec);
  const auto tips = tips_of(*s.model);
  ASSERT_EQ(tips.size(), 1u);
  const double k1 = tips[0].k1;
  std::cout << nx << " x " << ny << ", tip radius " << tip_radius << " m: K_I " << k1 << " / "
            << reference_k() << " Pa m^1/2, error " << 100 * (k1 / reference_k() - 1) << " %\n";
  EXPECT_NEAR(k1, reference_k(), k_error * reference_k());
  EXPECT_NEAR(tips[0].k2, 0.0, k_error * reference_k());
  double worst = 0.0;
  for (const ExpectedStress& e : expected_stresses(near_tip_case())) {
    if (e.r < two_elements(*s.model)) continue;
    const double angle = e.degrees * std::acos(-1.0) / 180;
    const Voigt stress = relative_stress(*s.model, e.r * std::cos(angle), e.r * std::sin(angle));
    const Voigt error = (stress - e.stress).cwiseAbs() / e.stress.norm();
    for (int k = 0; k < e.components; ++k) {
      worst = std::max(worst, error[k]);
      EXPECT_LE(error[k], stress_error)
          << "component " << k << " at r = " << e.r << " mm, " << e.degrees << " deg: " << stress[k]
          << ", reference " << e.stress[k];
    }
  }
  std::cout << "largest error of a stress " << 100 * worst << " %\n";
  write_numbers(*s.model, k1);
}

double case_tolerance() { return tolerance_of(near_tip_case()).stress_rel.value(); }

// With near-tip functions on the tip element only, this grid gives stresses ahead of the tip that
// are up to 4.2 % low, more than the 3 % of the case; with a tip radius they are within.
TEST(EdgeCrack, GridOfThePaper) { check(39, 103, 0.0, 0.02, 0.05); }
TEST(EdgeCrack, GridOfThePaperWithTipRadius) { check(39, 103, 2 * mm, 0.01, case_tolerance()); }
TEST(SlowEdgeCrack, FineGrid) { check(313, 825, 2 * mm, 0.005, case_tolerance()); }

}  // namespace
}  // namespace cdca::testing
