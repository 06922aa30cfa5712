// SPDX-License-Identifier: BSD-3-Clause
/// What must not change K nor the paths: turning and mirroring the body, the unit of length, the
/// order of the points of a crack and of the cracks, and cracks given in two parts (M7). Shifts
/// are in shift_test.cpp, ranks in tests/core/ranks_test.cpp.
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"
#include "tests/verification/reference_solve.hpp"

#include <gtest/gtest.h>

namespace cdca::testing {
namespace {

/// x -> scale q x, q a turn by a multiple of 90 degrees or a mirror, which map grids onto grids.
struct Map {
  const char* name;
  Eigen::Matrix2d q;
  double scale = 1.0;

  Vec2 operator()(const Vec2& x) const { return scale * (q * x); }
  bool swaps_axes() const { return std::abs(q(0, 0)) < 0.5; }
};

Map map_of(const char* name, double xx, double xy, double yx, double yy) {
  Map map{name, {}};
  map.q << xx, xy, yx, yy;
  return map;
}

void PrintTo(const Map& map, std::ostream* out) { *out << map.name; }

const Map same = map_of("same", 1, 0, 0, 1);

/// All the others of the symmetry group of the square.
std::vector<Map> turns_and_mirrors() {
  return {map_of("turned_90", 0, -1, 1, 0),      map_of("turned_180", -1, 0, 0, -1),
          map_of("turned_270", 0, 1, -1, 0),     map_of("mirrored_x", -1, 0, 0, 1),
          map_of("mirrored_y", 1, 0, 0, -1),     map_of("mirrored_diagonal", 0, 1, 1, 0),
          map_of("mirrored_other", 0, -1, -1, 0)};
}

using Lines = std::vector<std::vector<Vec2>>;

/// A kinked crack, a slanted one, and one from the rim: no symmetry whatever.
Lines lopsided() {
  return {{{0.33, 0.52}, {0.62, 0.61}, {0.74, 0.83}},
          {{0.58, 1.31}, {0.97, 1.12}},
          {{1.3, 0.47}, {1.08, 0.43}}};
}

constexpr double smallest_h = 1.3 / 29;

/// Elements that are not quite square, more of them in y than in x; tractions on all sides and a
/// pressure in the kinked crack.
CaseSpec mapped(const Lines& cracks, const Map& map, double tip_radius) {
  const Vec2 a = map(Vec2(0, 0)), b = map(Vec2(1.3, 1.7));
  const int nx = map.swaps_axes() ? 37 : 29, ny = map.swaps_axes() ? 29 : 37;
  CaseSpec spec = plate(a.cwiseMin(b), a.cwiseMax(b), nx, ny);
  spec.solver.tolerance = 1e-11;
  spec.tip_radius = map.scale * tip_radius;
  for (const auto& line : cracks) {
    std::vector<Vec2> points;
    for (const Vec2& x : line) points.push_back(map(x));
    add_crack(spec, points);
  }
  Eigen::Matrix2d s;
  s << 0.3, 0.2, 0.2, 1.0;
  s = map.q * s * map.q.transpose();
  pull(spec, Voigt(s(0, 0), s(1, 1), s(0, 1)));
  BoundarySpec faces;
  faces.kind = BoundaryKind::crack;
  faces.crack = spec.cracks.front().name;
  faces.pressure = proportional_load(0.2);
  spec.boundaries.push_back(faces);
  return spec;
}

struct Answer {
  std::vector<StressIntensity> tips;
  double energy = 0.0;
  int active_tips = 0;
  std::int64_t unknowns = 0;

  const StressIntensity& tip(int crack, int end) const {
    for (const StressIntensity& k : tips) {
      if (k.crack == crack && k.end == end) return k;
    }
    throw std::runtime_error("no such tip");
  }
  double largest() const {
    double k = 0.0;
    for (const StressIntensity& t : tips) k = std::max(k, std::hypot(t.k1, t.k2));
    return k;
  }
};

Answer answer_of(const CaseSpec& spec) {
  const Solved s = solved(spec);
  return {tips_of(*s.model), s.equilibrium.strain_energy, s.model->registry().active_tips(),
          s.model->unknowns().owned()};
}

constexpr double k_bar = 1e-6;       // the one equality rule
constexpr double energy_bar = 1e-9;  // second order in the errors of the displacements

/// Both relative to the largest K of the body.
void expect_same_tip(const StressIntensity& k, const StressIntensity& expected, double largest,
                     double k2_sign = 1.0) {
  EXPECT_NEAR(k.k1, expected.k1, k_bar * largest) << "crack " << k.crack << ", end " << k.end;
  EXPECT_NEAR(k2_sign * k.k2, expected.k2, k_bar * largest)
      << "crack " << k.crack << ", end " << k.end;
}

/// Near-tip functions in the tip element only, and on nodes within about three elements.
constexpr double tip_radii[] = {0.0, 0.13};

class TurnedAndMirrored : public ::testing::TestWithParam<Map> {};

TEST_P(TurnedAndMirrored, SameIntensities) {
  const Map& map = GetParam();
  const double sign = map.q.determinant();
  for (const double radius : tip_radii) {
    const Answer one = answer_of(mapped(lopsided(), same, radius));
    const Answer two = answer_of(mapped(lopsided(), map, radius));
    EXPECT_EQ(one.unknowns, two.unknowns);
    EXPECT_NEAR(one.energy, two.energy, energy_bar * one.energy);
    ASSERT_EQ(one.tips.size(), 5u);
    ASSERT_EQ(two.tips.size(), 5u);
    double difference = 0.0;
    for (const StressIntensity& k : one.tips) {
      const StressIntensity& other = two.tip(k.crack, k.end);
      expect_same_tip(other, k, one.largest(), sign);
      difference =
          std::max({difference, std::abs(other.k1 - k.k1), std::abs(sign * other.k2 - k.k2)});
    }
    std::cout << map.name << ", tip radius " << radius << ": largest difference "
              << difference / one.largest() << " of max |K|\n";
  }
}

/// Cracks that grow at every cycle, the second and third cycle with corrected directions.
CaseSpec growing(const Lines& cracks, const Map& map) {
  CaseSpec spec = mapped(cracks, map, 0.0);
  spec.load_factors = {2.0};
  spec.material.toughness = 1.0;
  spec.growth.criterion = Criterion::hoop;
  spec.growth.fixed_step = true;
  spec.growth.step_length = {1.3, 1.3};
  spec.growth.cycles = 4;
  return spec;
}

Summary grown(const CaseSpec& spec) {
  return run_simulation(spec, "test", world(), world_partitioner(), {});
}

void expect_same_path(const std::vector<Vec2>& path, std::vector<Vec2> expected, const Map& map) {
  ASSERT_EQ(path.size(), expected.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    EXPECT_LT((path[k] - map(expected[k])).norm(), 1e-4 * smallest_h * map.scale) << "point " << k;
  }
}

/// The test would be empty if tips stood still.
void expect_growth(const Summary& run, const Lines& initial) {
  std::size_t before = 0, now = 0;
  for (const auto& line : initial) before += line.size();
  for (const auto& crack : run.cracks) now += crack.points.size();
  EXPECT_GE(now, before + 8) << "hardly anything grew";
}

void expect_mapped_paths(const Map& map) {
  const Summary one = grown(growing(lopsided(), same));
  const Summary two = grown(growing(lopsided(), map));
  expect_growth(one, lopsided());
  ASSERT_EQ(one.cracks.size(), two.cracks.size());
  for (std::size_t c = 0; c < one.cracks.size(); ++c) {
    expect_same_path(two.cracks[c].points, one.cracks[c].points, map);
  }
}

class TurnedAndMirroredPaths : public ::testing::TestWithParam<Map> {};
TEST_P(TurnedAndMirroredPaths, AreTheSame) { expect_mapped_paths(GetParam()); }

class SlowTurnedAndMirroredPaths : public ::testing::TestWithParam<Map> {};
TEST_P(SlowTurnedAndMirroredPaths, AreTheSame) { expect_mapped_paths(GetParam()); }

std::vector<Map> every_third(bool chosen) {
  std::vector<Map> some;
  const auto all = turns_and_mirrors();
  for (std::size_t k = 0; k < all.size(); ++k) {
    if ((k % 3 == 0) == chosen) some.push_back(all[k]);
  }
  return some;
}

std::string name_of_map(const ::testing::TestParamInfo<Map>& map) { return map.param.name; }

INSTANTIATE_TEST_SUITE_P(Maps, TurnedAndMirrored, ::testing::ValuesIn(turns_and_mirrors()),
                         name_of_map);
INSTANTIATE_TEST_SUITE_P(Maps, TurnedAndMirroredPaths, ::testing::ValuesIn(every_third(true)),
                         name_of_map);
INSTANTIATE_TEST_SUITE_P(Maps, SlowTurnedAndMirroredPaths, ::testing::ValuesIn(every_third(false)),
                         name_of_map);

TEST(Reversed, PointsOfCracks) {
  Lines reversed = lopsided();
  for (auto& line : reversed) std::reverse(line.begin(), line.end());
  for (const double radius : tip_radii) {
    const Answer one = answer_of(mapped(lopsided(), same, radius));
    const Answer two = answer_of(mapped(reversed, same, radius));
    EXPECT_EQ(one.unknowns, two.unknowns);
    EXPECT_NEAR(one.energy, two.energy, energy_bar * one.energy);
    ASSERT_EQ(one.tips.size(), two.tips.size());
    for (const StressIntensity& k : one.tips) {
      expect_same_tip(two.tip(k.crack, 1 - k.end), k, one.largest());
    }
  }
  const Summary one = grown(growing(lopsided(), same)), two = grown(growing(reversed, same));
  expect_growth(one, lopsided());
  for (std::size_t c = 0; c < one.cracks.size(); ++c) {
    std::vector<Vec2> path = two.cracks[c].points;
    std::reverse(path.begin(), path.end());
    expect_same_path(path, one.cracks[c].points, same);
  }
}

TEST(Reversed, OrderOfCracks) {
  Lines reversed = lopsided();
  std::swap(reversed[1], reversed[2]);  // the pressure stays in the first
  const int number[] = {0, 2, 1};
  const Answer one = answer_of(mapped(lopsided(), same, 0.0));
  const Answer two = answer_of(mapped(reversed, same, 0.0));
  EXPECT_EQ(one.unknowns, two.unknowns);
  for (const StressIntensity& k : one.tips) {
    expect_same_tip(two.tip(number[k.crack], k.end), k, one.largest());
  }
  const Summary grown_one = grown(growing(lopsided(), same));
  const Summary grown_two = grown(growing(reversed, same));
  for (std::size_t c = 0; c < 3; ++c) {
    expect_same_path(grown_two.cracks[std::size_t(number[c])].points, grown_one.cracks[c].points,
                     same);
  }
}

/// The same stress in a body whose lengths are s times as large: K grows by sqrt(s), energy (per
/// thickness) by s^2. Absolute tolerances in the geometry would show here.
TEST(Scaled, LengthsByThousand) {
  for (const double scale : {1000.0, 1e-3}) {
    Map map = same;
    map.scale = scale;
    for (const double radius : tip_radii) {
      const Answer one = answer_of(mapped(lopsided(), same, radius));
      Answer two = answer_of(mapped(lopsided(), map, radius));
      EXPECT_EQ(one.unknowns, two.unknowns);
      EXPECT_NEAR(two.energy / (scale * scale), one.energy, energy_bar * one.energy);
      ASSERT_EQ(one.tips.size(), two.tips.size());
      for (const StressIntensity& k : one.tips) {
        StressIntensity other = two.tip(k.crack, k.end);
        other.k1 /= std::sqrt(scale);
        other.k2 /= std::sqrt(scale);
        expect_same_tip(other, k, one.largest());
      }
    }
  }
}

/// A straight crack, and the same one given as two that touch at a fraction of its length.
struct Split {
  Lines whole;
  Lines parts;
};

Split split(const Vec2& a, const Vec2& b, double fraction, bool second_reversed) {
  const Vec2 joint = a + fraction * (b - a);
  Split s{{{a, b}}, {{a, joint}, {joint, b}}};
  if (second_reversed) std::reverse(s.parts[1].begin(), s.parts[1].end());
  return s;
}

/// The pressure would act on the first part alone.
CaseSpec without_pressure(const Lines& cracks, double tip_radius) {
  CaseSpec spec = mapped(cracks, same, tip_radius);
  spec.boundaries.pop_back();
  return spec;
}

void expect_same_when_split(const Split& s, bool second_reversed, double tip_radius) {
  const Answer one = answer_of(without_pressure(s.whole, tip_radius));
  const Answer two = answer_of(without_pressure(s.parts, tip_radius));
  EXPECT_EQ(two.active_tips, 2) << "the touching ends are no tips";
  ASSERT_EQ(two.tips.size(), 2u);
  // a face that did not open would cost energy: the load is given, so less work were stored
  EXPECT_EQ(one.unknowns, two.unknowns);
  EXPECT_NEAR(one.energy, two.energy, energy_bar * one.energy);
  expect_same_tip(two.tip(0, 0), one.tip(0, 0), one.largest());
  expect_same_tip(two.tip(1, second_reversed ? 0 : 1), one.tip(0, 1), one.largest());
}

TEST(SplitCracks, JointAnywhereAlongASlantedCrack) {
  for (const double fraction : {0.35, 0.5, 0.57}) {
    for (const bool reversed : {false, true}) {
      for (const double radius : tip_radii) {
        SCOPED_TRACE(::testing::Message() << "joint at " << fraction << ", tip radius " << radius);
        expect_same_when_split(split({0.37, 0.71}, {1.01, 1.13}, fraction, reversed), reversed,
                               radius);
      }
    }
  }
}

TEST(SplitCracks, JointAtANode) {
  const double hx = 1.3 / 29, hy = 1.7 / 37;
  const Vec2 node(14 * hx, 19 * hy), along(0.33, 0.17), level(0.34, 0);
  for (const Vec2& half : {along, level}) {  // across the grid lines, and on one
    expect_same_when_split(split(node - half, node + half, 0.5, false), false, 0.0);
  }
}

/// The joint lies within reach of the near-tip functions and of the domain of the integral.
TEST(SplitCracks, JointBesideATip) {
  const Vec2 a(0.37, 0.71), b(1.01, 1.13);
  for (const double elements : {1.4, 3.0}) {
    for (const double radius : tip_radii) {
      SCOPED_TRACE(::testing::Message() << elements << " elements, tip radius " << radius);
      const double fraction = 1 - elements * smallest_h / (b - a).norm();
      expect_same_when_split(split(a, b, fraction, false), false, radius);
    }
  }
}

TEST(SplitCracks, GrowLikeTheWhole) {
  const Split s = split({0.37, 0.71}, {1.01, 1.13}, 0.5, false);
  CaseSpec whole = growing(s.whole, same), parts = growing(s.parts, same);
  whole.boundaries.pop_back();
  parts.boundaries.pop_back();
  const Summary one = grown(whole), two = grown(parts);
  expect_growth(one, s.whole);
  ASSERT_EQ(two.cracks.size(), 2u);
  std::vector<Vec2> path = two.cracks[0].points;
  path.pop_back();  // the joint
  path.insert(path.end(), two.cracks[1].points.begin() + 1, two.cracks[1].points.end());
  expect_same_path(path, one.cracks[0].points, same);
}

}  // namespace
}  // namespace cdca::testing
