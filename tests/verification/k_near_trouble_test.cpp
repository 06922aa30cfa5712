// SPDX-License-Identifier: BSD-3-Clause
/// K of tips that have little room: a kink 1, 2 or 4 elements behind them, another crack or the rim
/// at 1.5 elements. Each within 3 % (of |K| of the tip) of the same case on a grid four times
/// finer, where the same tip has four times as many elements of room.
#include "tests/plates.hpp"
#include "tests/verification/reference_report.hpp"
#include "tests/verification/reference_solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

namespace cdca::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double bar = 0.03;
constexpr int coarse = 41;          // an odd number: nothing lies along grid lines by chance
constexpr double h = 2.0 / coarse;  // of the coarse grid

Vec2 direction(double degrees) {
  return {std::cos(degrees * pi / 180), std::sin(degrees * pi / 180)};
}

using Layout = std::vector<std::vector<Vec2>>;

/// Load, and how many elements of the grid the near-tip functions reach: 0 means the tip element
/// only, the default; 4.2 is the rule of the reference cases.
struct Setting {
  Voigt stress{0.2, 1, 0.1};
  double enriched = 0.0;
};
const Setting biaxial{{0.9, 1, 0.1}};

/// K of all tips on the grid `refinement` times finer, in the shape that compare_tips takes.
std::vector<ExpectedTip> tips_on(const Layout& cracks, const Setting& setting, int refinement) {
  CaseSpec spec = plate({-1, -1}, {1, 1}, coarse * refinement, coarse * refinement);
  spec.tip_radius = setting.enriched * h / refinement;
  spec.solver.tolerance = 1e-7;
  for (const auto& points : cracks) add_crack(spec, points);
  pull(spec, setting.stress);
  const Solved s = solved(spec);
  std::vector<ExpectedTip> tips;
  for (const StressIntensity& k : tips_of(*s.model)) {
    const Crack& crack = s.model->registry().cracks()[std::size_t(k.crack)];
    tips.push_back({crack.end_point(k.end), k.k1, k.k2});
  }
  return tips;
}

/// How far a tip is from the rim, another crack or a bend of its own crack, in elements of the
/// coarse grid.
double room_of(const Vec2& tip, const Layout& cracks) {
  double least = std::min((tip.array() + 1).minCoeff(), (1 - tip.array()).minCoeff());
  for (const auto& p : cracks) {
    const bool own = (p.front() - tip).norm() < 1e-9 || (p.back() - tip).norm() < 1e-9;
    for (std::size_t k = 1; k < p.size(); ++k) {
      const Vec2 foot = p[k - 1] + nearest_fraction(p[k - 1], p[k], tip) * (p[k] - p[k - 1]);
      if (!own) least = std::min(least, (foot - tip).norm());
      if (own && k + 1 < p.size()) least = std::min(least, (p[k] - tip).norm());
    }
  }
  return least / h;
}

/// Tips with more room than this are logged only: what they miss is the coarse grid, no trouble.
constexpr double little_room = 4.1;

void expect_as_on_the_finer_grid(const std::string& name, const Layout& cracks, int tips_in_trouble,
                                 const Setting& setting = {}) {
  const auto fine = tips_on(cracks, setting, 4), rough = tips_on(cracks, setting, 1);
  ASSERT_EQ(fine.size(), rough.size());
  ReferenceTolerance tolerance;
  tolerance.k_rel = bar;
  const ReferenceResult result{name, "", compare_tips(fine, rough, tolerance), ""};
  std::cout << log_of(result);
  int judged = 0;
  for (std::size_t k = 0; k < fine.size(); ++k) {
    if (room_of(fine[k].at, cracks) > little_room) continue;
    ++judged;
    // faces do not touch yet: only the K of tips that the load opens are right
    EXPECT_GT(fine[k].k1, 0.0) << name << " is no case for this test";
    for (const std::size_t c : {2 * k, 2 * k + 1}) {  // K_I and K_II
      const Comparison& compared = result.comparisons.at(c);
      EXPECT_LE(compared.error, bar) << name << ": " << compared.quantity << ", " << compared.place;
    }
  }
  EXPECT_EQ(judged, tips_in_trouble);
}

/// A crack with a kink at both ends, turned by `kink` degrees at its end and by half of it the
/// other way at its start, so that one solution tests two kinks.
struct Kinks {
  double elements;   ///< length of the kinked parts
  double kink;       ///< degrees
  double direction;  ///< of the crack, degrees
  Vec2 middle;       ///< in elements off the middle of the plate

  std::vector<Vec2> points() const {
    const Vec2 along = testing::direction(direction), centre = h * middle;
    const Vec2 first = centre - 0.4 * along, last = centre + 0.4 * along;
    const double length = elements * h;
    return {first - length * testing::direction(direction - 0.5 * kink), first, last,
            last + length * testing::direction(direction + kink)};
  }
  std::string name() const {
    std::ostringstream text;
    text << "kink of " << kink << " deg, " << elements << " h, crack at " << direction << " deg";
    return text.str();
  }
};

void check(const Kinks& k, const Setting& setting = {}) {
  expect_as_on_the_finer_grid(k.name(), {k.points()}, 2, setting);
}

class NearKinks : public ::testing::TestWithParam<double> {};

TEST_P(NearKinks, AsOnTheFinerGrid) { check({GetParam(), 45, 0, {0.03, 0.06}}); }

std::string name_of_length(const ::testing::TestParamInfo<double>& length) {
  return "elements_" + std::to_string(int(length.param));
}

INSTANTIATE_TEST_SUITE_P(Kinks, NearKinks, ::testing::Values(1.0, 2.0, 4.0), name_of_length);

class SlowNearKinks : public ::testing::TestWithParam<double> {};

TEST_P(SlowNearKinks, AsOnTheFinerGrid) {
  for (const double kink : {-30.0, 45.0, 70.0}) {
    check({GetParam(), kink, 0, {0.31, -0.42}});
    check({GetParam(), kink, 17, {0.31, -0.42}}, biaxial);
    check({GetParam(), kink, 45, {0.5, 0.5}}, biaxial);  // its middle at a node
  }
}

INSTANTIATE_TEST_SUITE_P(Kinks, SlowNearKinks, ::testing::Values(1.0, 2.0, 4.0), name_of_length);

/// A crack whose end is `distance` elements off the face of another, longer one. The ends of the
/// other are farther away than that.
struct Neighbour {
  double angle;           ///< of the other crack from this one, degrees
  double bearing;         ///< of its nearest point, from this one's direction, degrees
  double along;           ///< where on the other its nearest point lies: 0.5 in the middle
  Vec2 middle;            ///< in elements
  double distance = 1.5;  ///< in elements

  Layout cracks() const {
    const Vec2 first = h * middle - Vec2(0.5, 0), tip = h * middle + Vec2(0.1, 0);
    const Vec2 foot = tip + distance * h * direction(bearing);
    const Vec2 other = 0.9 * direction(angle);
    return {{first, tip}, {foot - along * other, foot + (1 - along) * other}};
  }
};

void check(const std::string& name, const Neighbour& n, int tips_in_trouble = 1,
           const Setting& setting = {}) {
  // the foot is the nearest point only if the way to it stands at right angles on the other crack
  ASSERT_NEAR(std::abs(std::cos((n.angle - n.bearing) * pi / 180)), 0.0, 1e-12);
  expect_as_on_the_finer_grid(name, n.cracks(), tips_in_trouble, setting);
}

TEST(NearAnotherCrack, AcrossTheWay) { check("across", {90, 0, 0.55, {0.03, 0.06}}); }

TEST(NearTheRim, StraightOn) {
  const double y = 0.06 * h;
  expect_as_on_the_finer_grid("rim, straight on", {{{-0.1, y}, {1 - 1.5 * h, y}}}, 1);
}

/// The results say how much of the domain was left.
TEST(NearTheRim, TheDomainIsSmaller) {
  CaseSpec spec = plate({-1, -1}, {1, 1}, coarse, coarse);
  add_crack(spec, {{-0.1, 0.003}, {1 - 4.5 * h, 0.003}});
  add_crack(spec, {{-0.8, 0.603}, {1 - 1.5 * h, 0.603}});
  pull(spec, biaxial.stress);
  const Solved s = solved(spec);
  const auto tips = tips_of(*s.model);
  ASSERT_EQ(tips.size(), 4u);
  EXPECT_DOUBLE_EQ(tips[0].radius, 5 * h);
  EXPECT_NEAR(tips[1].radius, 4.5 * h, 0.01 * h);
  EXPECT_LT(tips[1].radius, 4.5 * h);
  EXPECT_DOUBLE_EQ(tips[3].radius, 4 * h) << "never less: the formula holds across the rim";
}

/// By the reach of the near-tip functions.
class SlowNearOthers : public ::testing::TestWithParam<double> {
 protected:
  Setting setting() const { return {{0.2, 1, 0.1}, GetParam()}; }
};

TEST_P(SlowNearOthers, AcrossTheWay) {
  check("across, elsewhere", {90, 0, 0.3, {0.37, -0.21}}, 1, setting());
  check("across, on grid lines", {90, 0, 0.5, {0.5, 0.5}}, 1, setting());
}

TEST_P(SlowNearOthers, Slanted) {
  check("60 deg ahead", {60, -30, 0.5, {0.03, 0.06}}, 1, setting());
  check("45 deg ahead", {45, -45, 0.4, {0.37, -0.21}}, 1, setting());
  check("-45 deg ahead", {-45, 45, 0.6, {0.21, 0.44}}, 1, setting());
  check("25 deg ahead", {25, -65, 0.5, {0.03, 0.06}}, 1, setting());
}

TEST_P(SlowNearOthers, Beside) {
  check("beside, overlapping", {0, 90, 0.5, {0.03, 0.06}}, 3, setting());
  check("beside, other side", {0, -90, 0.3, {0.37, -0.21}}, 2, setting());
  check("beside, -10 deg", {-10, 80, 0.6, {0.21, 0.44}}, 3, setting());
}

TEST_P(SlowNearOthers, SlantedToTheRim) {
  const Vec2 right(1 - 1.5 * h, 0.21), top(0.3, 1 - 1.5 * h);
  const auto towards = [](const Vec2& tip, double degrees) {
    return Layout{{tip - 0.8 * direction(degrees), tip}};
  };
  expect_as_on_the_finer_grid("right side, 60 deg", towards(right, 30), 1, setting());
  expect_as_on_the_finer_grid("top side, 60 deg", towards(top, 60), 1, setting());
  expect_as_on_the_finer_grid("top side, 45 deg", towards(top, 45), 1, setting());
}

/// Neighbours at any angle, nearest and farthest in elements. Limits of the method are stated here:
/// tips in the shadow of a longer crack, whose |K| is small, may miss the bar. Returns the largest
/// error.
double check_random_neighbours(unsigned seed, int count, double nearest, double farthest) {
  std::mt19937 random(seed);
  const auto any = [&random](double from, double to) {
    return from + (to - from) * (double(random()) / double(std::mt19937::max()));
  };
  std::vector<double> errors;
  for (int k = 0; k < count; ++k) {
    const double angle = any(-80, 80), distance = any(nearest, farthest), along = any(0.2, 0.8);
    const Vec2 middle(any(0, 1), any(0, 1));
    const double bearing = angle > 0 ? angle - 90 : angle + 90;
    const Layout cracks = Neighbour{angle, bearing, along, middle, distance}.cracks();
    const ExpectedTip fine = tips_on(cracks, {}, 4).at(1), rough = tips_on(cracks, {}, 1).at(1);
    const double size = std::hypot(fine.k1, fine.k2);
    const double off = std::max(std::abs(rough.k1 - fine.k1), std::abs(rough.k2 - fine.k2));
    errors.push_back(off / size);
    std::cout << angle << " deg at " << distance << " elements: K_I " << fine.k1 << ", K_II "
              << fine.k2 << ", off by " << 100 * errors.back() << " %\n";
  }
  std::sort(errors.begin(), errors.end());
  const auto over = errors.end() - std::upper_bound(errors.begin(), errors.end(), bar);
  std::cout << "median " << 100 * errors[errors.size() / 2] << " %, largest " << 100 * errors.back()
            << " %, over the bar " << over << "\n";
  EXPECT_LT(errors[errors.size() / 2], 0.01);
  EXPECT_LE(over, count / 20);
  return errors.back();
}

TEST(SlowRandomNeighbours, NearlyAllAsOnTheFinerGrid) {
  EXPECT_LT(check_random_neighbours(5, 60, 1.3, 4.0), 0.06);
}

/// The largest error is printed only: it is of tips with next to no K left.
TEST(SlowRandomNeighbours, OneAndAHalfElementsAway) { check_random_neighbours(11, 100, 1.5, 1.5); }

/// Do the cracks keep this distance (elements) from each other?
bool are_apart(const Layout& cracks, double distance) {
  constexpr int places = 200;
  for (std::size_t a = 0; a < cracks.size(); ++a) {
    for (std::size_t b = 0; b < cracks.size(); ++b) {
      for (int k = 0; a != b && k <= places; ++k) {
        const Vec2 at = cracks[a][0] + double(k) / places * (cracks[a][1] - cracks[a][0]);
        const Vec2 foot = cracks[b][0] + nearest_fraction(cracks[b][0], cracks[b][1], at) *
                                             (cracks[b][1] - cracks[b][0]);
        if ((foot - at).norm() < distance * h) return false;
      }
    }
  }
  return true;
}

/// Cracks from any sides that end within a few elements of one place, where their tips want the
/// same cells.
class SlowCrowdedTips : public ::testing::TestWithParam<std::size_t> {};

TEST_P(SlowCrowdedTips, NearlyAllAsOnTheFinerGrid) {
  constexpr std::size_t count = 30;
  std::mt19937 random(3);
  const auto any = [&random](double from, double to) {
    return from + (to - from) * (double(random()) / double(std::mt19937::max()));
  };
  std::vector<double> errors;
  double largest_over = 0.0;  // |K| over that of a crack alone, of tips that miss the bar
  while (errors.size() < GetParam() * count) {
    Layout cracks;
    const Vec2 middle(any(0, 1), any(0, 1));
    for (std::size_t k = 0; k < GetParam(); ++k) {
      const Vec2 tip = h * (middle + Vec2(any(-2, 2), any(-2, 2)));
      cracks.push_back({tip + any(0.3, 0.6) * direction(any(0, 360)), tip});
    }
    if (!are_apart(cracks, 1.2)) continue;
    const auto fine = tips_on(cracks, biaxial, 4), rough = tips_on(cracks, biaxial, 1);
    for (std::size_t k = 1; k < fine.size(); k += 2) {
      const double size = std::hypot(fine[k].k1, fine[k].k2);
      errors.push_back(
          std::max(std::abs(rough[k].k1 - fine[k].k1), std::abs(rough[k].k2 - fine[k].k2)) / size);
      // the load is nearly the same in all directions: a crack alone has K = sigma sqrt(pi a)
      const double half_length = 0.5 * (cracks[k / 2][1] - cracks[k / 2][0]).norm();
      const double left = size / std::sqrt(pi * half_length);
      if (errors.back() > bar) largest_over = std::max(largest_over, left);
      std::cout << fine[k].k1 << ", " << fine[k].k2 << " off by " << 100 * errors.back()
                << " %, |K| is " << left << " of that of a crack alone\n";
    }
  }
  std::sort(errors.begin(), errors.end());
  const auto over = errors.end() - std::upper_bound(errors.begin(), errors.end(), bar);
  std::cout << "median " << 100 * errors[errors.size() / 2] << " %, largest " << 100 * errors.back()
            << " %, over the bar " << over << ", with at most " << largest_over
            << " of the K alone\n";
  EXPECT_LT(errors[errors.size() / 2], 0.01);
  EXPECT_LE(over, std::ptrdiff_t(errors.size() / 20));
  EXPECT_LT(largest_over, 0.5);
}
INSTANTIATE_TEST_SUITE_P(Tips, SlowCrowdedTips, ::testing::Values(3, 4, 5),
                         [](const auto& test) { return std::to_string(test.param); });

std::string name_of_zone(const ::testing::TestParamInfo<double>& reach) {
  return reach.param == 0.0 ? "tip_element_only" : "wide_zone";
}

INSTANTIATE_TEST_SUITE_P(Zones, SlowNearOthers, ::testing::Values(0.0, 4.2), name_of_zone);

}  // namespace
}  // namespace cdca::testing
