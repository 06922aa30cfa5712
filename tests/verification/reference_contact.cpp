// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/reference_contact.hpp"

#include "core/mechanics/fracture_criterion.hpp"
#include "core/simulation/drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cdca::testing {

namespace {

constexpr double pi = std::numbers::pi;

std::vector<Comparison> compared_tips(const ReferenceCase& c, const ReferenceGeometry& g,
                                      const ReferenceLoad& load, const SolvedReference& s) {
  const auto expected = expected_tips(c);
  EXPECT_EQ(expected.size(), s.tips.size()) << "a tip without reference";
  auto computed = expected;
  for (ExpectedTip& tip : computed) {
    const StressIntensity& k = tip_at(s, tip.at);
    tip.k1 = k.k1;
    tip.k2 = k.k2;
  }
  if (g.infinite) std::cout << c.id << ": rim settled after " << s.solves << " solves\n";
  const double unit = load.stress.cwiseAbs().maxCoeff() * std::sqrt(pi * g.longest());
  return compare_tips(expected, computed, tolerance_of(c), unit);
}

/// Where faces that touch at the beginning of a straight crack along x stop to do so.
double closure_point(const Model& model) {
  const CrackPart faces = draw_cracks(model);
  const auto& points = model.registry().cracks().at(0).points;
  double open_from = points.back().x();
  for (std::size_t k = 0; k < faces.crack.size(); ++k) {
    const double from = std::min(faces.points[4 * k], faces.points[4 * k + 2]);
    if (faces.contact_state[k] == int(ContactState::open)) open_from = std::min(open_from, from);
  }
  return open_from;
}

Comparison relative(const std::string& what, double computed, double reference, double allowed) {
  return {"", what, computed, reference, std::abs(computed / reference - 1), allowed};
}

/// Flaws under 45 degrees; m, MPa.
struct PaperFlaw {
  double half_length, friction, strength, toughness;
};
PaperFlaw paper_flaw(const ReferenceCase& c) {
  if (c.id == "paper_5.2_derived") return {6e-3, 0.45, 0.35, 0.0443};
  if (c.id == "paper_5.3_derived") return {1.5e-3, 0.5, 3.24, 1.03};
  throw std::runtime_error(c.id + " is not known");
}

}  // namespace

std::string size_of(const ReferenceGrid& grid) {
  return std::to_string(grid.nx) + " x " + std::to_string(grid.ny);
}

ReferenceResult tip_intensities(const ReferenceCase& c, const ReferenceGrid& grid) {
  const ReferenceGeometry g = geometry_of(c);
  const ReferenceLoad load = load_of(c);
  const SolvedReference s = solve_reference(g, load, grid);
  return {c.id, size_of(grid), compared_tips(c, g, load, s), ""};
}

ReferenceResult partly_closed(const ReferenceCase& c) {
  const ReferenceGeometry g = geometry_of(c);
  const ReferenceGrid grid = grid_of(g);
  const double a = g.longest(), h = (grid.upper.x() - grid.lower.x()) / grid.nx;
  const double reference = c.json.at("reference").at("closure_point_x_over_a");
  ReferenceResult result{c.id, size_of(grid), {}, ""};
  ReferenceLoad load = load_of(c);
  for (const double friction : {0.0, 0.4}) {
    load.friction = friction;
    const SolvedReference s = solve_reference(g, load, grid);
    for (const Comparison& k : compared_tips(c, g, load, s)) result.comparisons.push_back(k);
    const double at = closure_point(*s.model) / a;
    result.comparisons.push_back({"faces", "closes at x/a", at, reference, std::abs(at - reference),
                                  tolerance_of(c).closure_elements.value() * h / a});
  }
  return result;
}

ReferenceResult paper_numbers(const ReferenceCase& c) {
  const PaperFlaw flaw = paper_flaw(c);
  ReferenceGeometry g;
  g.infinite = true;
  const Vec2 end = flaw.half_length * Vec2(1, 1).normalized();
  g.cracks.push_back({{-end, end}, {true, true}});
  const ReferenceGrid grid = grid_of(g);
  const ReferenceLoad load{ReferenceLoad::Kind::stress, {0, -1, 0}, 0.0, flaw.friction};
  const SolvedReference s = solve_reference(g, load, grid);
  const StressIntensity& tip = tip_at(s, end);
  Strength strength;
  strength.tensile = flaw.strength;
  strength.toughness = flaw.toughness;
  const double index = judge_hoop(tip.k1, tip.k2, strength).u_tension;
  const auto& r = c.json.at("reference");
  const ReferenceTolerance t = tolerance_of(c);
  const auto number = [&](const char* key) { return r.at(key).get<double>(); };
  return {c.id,
          size_of(grid),
          {relative("K_II for 1 MPa", std::abs(tip.k2), number("KII_per_MPa"), t.k2_rel.value()),
           relative("MPa at first growth", 1 / index, number("sigma_wing_init_MPa_inf"),
                    t.initiation_rel.value()),
           relative("mm of arrest", 1e3 * strength.critical_distance().value(),
                    number("arrest_radius_mm"), t.arrest_rel.value())},
          ""};
}

}  // namespace cdca::testing
