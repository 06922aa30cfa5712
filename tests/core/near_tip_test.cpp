// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/near_tip.hpp"

#include "core/cracks/segments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <random>
#include <string>

namespace cdca {
namespace {

constexpr double pi = std::numbers::pi;

/// A crack seen from its tip at (0.2, 0.1): straight pieces of the given lengths, turning left by
/// the given angles (degrees) on the way back.
std::vector<Vec2> bent_path(const std::vector<double>& lengths, const std::vector<double>& turns) {
  std::vector<Vec2> path{{0.2, 0.1}};
  double angle = pi + 0.3;  // the tangent of the tip points to 0.3
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    if (k > 0) angle += turns[k - 1] * pi / 180;
    path.push_back(path.back() + lengths[k] * Vec2(std::cos(angle), std::sin(angle)));
  }
  return path;
}

struct BentCrack {
  std::string name;
  std::vector<Vec2> path;
};

std::ostream& operator<<(std::ostream& out, const BentCrack& crack) { return out << crack.name; }

const std::vector<BentCrack> cracks{
    {"straight", bent_path({3.0}, {})},
    {"kink_of_30_degrees", bent_path({0.5, 3.0}, {30})},
    {"kink_of_70_degrees", bent_path({0.5, 3.0}, {70})},
    {"kink_of_70_degrees_to_the_right", bent_path({0.5, 3.0}, {-70})},
    {"two_kinks", bent_path({0.4, 0.7, 3.0}, {70, -40})},
    {"two_kinks_that_add_up", bent_path({0.4, 0.5, 3.0}, {30, 45})},
};

class NearTipTest : public ::testing::TestWithParam<BentCrack> {
 protected:
  const std::vector<Vec2>& path() const { return GetParam().path; }
  bool crosses_the_crack(const Vec2& a, const Vec2& b) const {
    for (std::size_t k = 0; k + 1 < path().size(); ++k)
      if (crossing_of(a, b, path()[k], path()[k + 1])) return true;
    return false;
  }
  /// Distance of a place from the circles on which the frame bends.
  double from_bend(const Vec2& x) const {
    double nearest = 1e300;
    for (std::size_t k = 1; k < path().size(); ++k)
      nearest =
          std::min(nearest, std::abs((x - path()[0]).norm() - (path()[k] - path()[0]).norm()));
    return nearest;
  }
  TipFrame frame_{GetParam().path, false};
};

TEST_P(NearTipTest, GradientsAreDifferences) {
  constexpr double h = 1e-6;
  std::mt19937 random(41);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  int compared = 0;
  for (int k = 0; k < 300; ++k) {
    const Vec2 x = frame_.tip() + Vec2(any(random), any(random));
    if ((x - frame_.tip()).norm() < 0.05 || from_bend(x) < 1e-4) continue;
    if (crosses_the_crack(x - Vec2(h, h), x + Vec2(h, h)) ||
        crosses_the_crack(x - Vec2(h, -h), x + Vec2(h, -h)))
      continue;
    ++compared;
    const TipPolar at = frame_.polar(x);
    const NearTipValues f = near_tip_functions(at);
    for (int axis = 0; axis < 2; ++axis) {
      Vec2 d(0, 0);
      d[axis] = h;
      const TipPolar low = frame_.polar(x - d), high = frame_.polar(x + d);
      EXPECT_NEAR((high.r - low.r) / (2 * h), at.grad_r[axis], 1e-8);
      EXPECT_NEAR((high.theta - low.theta) / (2 * h), at.grad_theta[axis],
                  1e-5 * (1 + at.grad_theta.norm()));
      const auto f_low = near_tip_functions(low).value, f_high = near_tip_functions(high).value;
      for (std::size_t l = 0; l < 4; ++l)
        EXPECT_NEAR((f_high[l] - f_low[l]) / (2 * h), f.gradient[l][axis],
                    1e-5 * (1 + f.gradient[l].norm()));
    }
  }
  EXPECT_GT(compared, 250);
}

TEST_P(NearTipTest, AnglesOnTheFacesArePlusAndMinusPi) {
  for (std::size_t k = 0; k + 1 < path().size(); ++k) {
    for (const double t : {0.01, 0.3, 0.5, 0.99}) {
      const Vec2 x = path()[k] + t * (path()[k + 1] - path()[k]);
      const TipPolar plus = frame_.polar(x, FaceSide::plus),
                     minus = frame_.polar(x, FaceSide::minus);
      EXPECT_NEAR(plus.theta, pi, 1e-12);
      EXPECT_NEAR(minus.theta, -pi, 1e-12);
      const double root = std::sqrt((x - frame_.tip()).norm());
      EXPECT_NEAR(near_tip_functions(plus).value[0], root, 1e-12);
      EXPECT_NEAR(near_tip_functions(minus).value[0], -root, 1e-12);
      for (std::size_t l = 1; l < 4; ++l)
        EXPECT_NEAR(near_tip_functions(plus).value[l], 0.0, 1e-12)
            << "only the first opens the crack";
    }
  }
}

/// Convex pieces round the tip, as faces cut them off: functions go on from inside to the rim, on
/// faces of another crack that ends here close to this one, too.
TEST_P(NearTipTest, GoOnFromInsideAPiece) {
  constexpr double r = 0.3, nearest = 1e-9;  // where all these cracks are straight
  const auto at = [&](double angle) {
    const Vec2 along = frame_.tangent();
    return Vec2(frame_.tip() +
                r * (std::cos(angle) * along + std::sin(angle) * turned_left(along)));
  };
  for (const double other : {-0.99 * pi, -0.8 * pi, 0.1 * pi, 0.6 * pi, 0.8 * pi, 0.99 * pi}) {
    // from where the other crack is to either face of this one, as far as a convex piece reaches
    for (const double face : {-pi, pi}) {
      const double width = std::clamp(face - other, -0.95 * pi, 0.95 * pi);
      const double inwards = width > 0 ? nearest : -nearest;
      const auto beside = near_tip_functions(frame_.polar(at(other + inwards))).value;
      const auto beyond = near_tip_functions(frame_.polar(at(other + width - inwards))).value;
      for (const double part : {0.1, 0.5, 0.9}) {
        const Vec2 inside = at(other + part * width);
        const auto here = near_tip_functions(frame_.polar_beside(at(other), inside)).value;
        const auto there = near_tip_functions(frame_.polar_beside(at(other + width), inside)).value;
        for (std::size_t l = 0; l < 4; ++l) {
          EXPECT_NEAR(here[l], beside[l], 1e-8);
          EXPECT_NEAR(there[l], beyond[l], 1e-8);
        }
      }
    }
  }
}

TEST_P(NearTipTest, PlusIsOnTheLeftOfTheWayToTheTip) {
  for (std::size_t k = 0; k + 1 < path().size(); ++k) {
    const Vec2 way = path()[k] - path()[k + 1];
    const Vec2 x = 0.5 * (path()[k] + path()[k + 1]), left = 1e-7 * turned_left(way).normalized();
    EXPECT_NEAR(frame_.polar(x + left).theta, pi, 1e-5);
    EXPECT_NEAR(frame_.polar(x - left).theta, -pi, 1e-5);
  }
}

/// On rings round the tip the functions are continuous everywhere but across the crack.
TEST_P(NearTipTest, JumpsAcrossTheCrackOnly) {
  constexpr int n = 3600;
  for (const double r : {0.1, 0.49, 0.51, 0.8, 1.3, 2.2}) {
    int jumps = 0;
    const auto place = [&](int k) {
      const double angle = 2 * pi * (k + 0.41) / n;
      return Vec2(frame_.tip() + r * Vec2(std::cos(angle), std::sin(angle)));
    };
    for (int k = 0; k < n; ++k) {
      const auto here = near_tip_functions(frame_.polar(place(k))).value;
      const auto next = near_tip_functions(frame_.polar(place(k + 1))).value;
      double largest = 0.0;
      for (std::size_t l = 0; l < 4; ++l) largest = std::max(largest, std::abs(next[l] - here[l]));
      if (crosses_the_crack(place(k), place(k + 1))) {
        ++jumps;
        EXPECT_NEAR(largest, 2 * std::sqrt(r), 0.02) << "the crack opens";
      } else {
        EXPECT_LT(largest, 0.01) << "r = " << r << ", place " << k;
      }
    }
    EXPECT_EQ(jumps, 1) << "r = " << r;
  }
}

TEST_P(NearTipTest, AreContinuousAlongRays) {
  constexpr int n = 2000;
  for (int ray = 0; ray < 36; ++ray) {
    const Vec2 d(std::cos(0.17 + ray * pi / 18), std::sin(0.17 + ray * pi / 18));
    for (int k = 10; k < n; ++k) {
      const Vec2 x = frame_.tip() + 2.5 * k / n * d, y = frame_.tip() + 2.5 * (k + 1) / n * d;
      if (crosses_the_crack(x, y)) continue;
      EXPECT_NEAR(frame_.polar(x).theta, frame_.polar(y).theta, 0.06) << "ray " << ray << ", " << k;
    }
  }
}

/// The angle for fields that are continued up to the faces is the plain one but for whole turns.
TEST_P(NearTipTest, AngleGoesOnUpToTheFaces) {
  for (std::size_t k = 0; k + 1 < path().size(); ++k) {
    for (const double t : {0.1, 0.6}) {
      const Vec2 x = path()[k] + t * (path()[k + 1] - path()[k]), d = frame_.local(x);
      const double plus = frame_.angle(x, FaceSide::plus), minus = frame_.angle(x, FaceSide::minus);
      EXPECT_NEAR(plus - minus, 2 * pi, 1e-12);
      for (const double angle : {plus, minus})
        EXPECT_LT((Vec2(std::cos(angle), std::sin(angle)) - d.normalized()).norm(), 1e-12);
      const Vec2 left = 1e-7 * turned_left(path()[k] - path()[k + 1]).normalized();
      EXPECT_NEAR(frame_.angle(x + left), plus, 1e-5);
      EXPECT_NEAR(frame_.angle(x - left), minus, 1e-5);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cracks, NearTipTest, ::testing::ValuesIn(cracks),
                         [](const auto& test) { return test.param.name; });

TEST(NearTipFunctionsTest, AreThoseOfEquationFive) {
  TipPolar p;
  p.r = 4.0;
  p.theta = pi / 2;
  const double s = std::sqrt(0.5);
  const auto f = near_tip_functions(p).value;
  for (std::size_t l = 0; l < 4; ++l) EXPECT_NEAR(f[l], 2 * s, 1e-14);
  p.theta = 0.0;
  const auto ahead = near_tip_functions(p).value;
  EXPECT_EQ(ahead, (std::array<double, 4>{0.0, 2.0, 0.0, 0.0}));
}

TEST(NearTipFunctionsTest, VanishAtTheTip) {
  const TipFrame frame({{1, 1}, {0, 1}}, true);
  const NearTipValues f = near_tip_functions(frame.polar(Vec2(1, 1)));
  for (std::size_t l = 0; l < 4; ++l) {
    EXPECT_EQ(f.value[l], 0.0);
    EXPECT_TRUE(f.gradient[l].allFinite());
  }
}

TEST(TipFrameTest, StraightCrackHasPlainPolarCoordinates) {
  const TipFrame frame({{1, 1}, {0, 0}}, true);
  EXPECT_TRUE(frame.tangent().isApprox(Vec2(std::sqrt(0.5), std::sqrt(0.5)), 1e-15));
  EXPECT_TRUE(frame.local(Vec2(1, 3)).isApprox(Vec2(std::sqrt(2), std::sqrt(2)), 1e-14));
  for (const double angle : {-3.0, -1.0, 0.0, 0.5, 3.1}) {
    const Vec2 x = Vec2(1, 1) + 0.7 * Vec2(std::cos(angle + pi / 4), std::sin(angle + pi / 4));
    EXPECT_NEAR(frame.polar(x).theta, angle, 1e-12);
    EXPECT_NEAR(frame.polar(x).r, 0.7, 1e-14);
  }
}

TEST(TipFrameTest, TipIsStraightBeforeTheFirstKink) {
  const TipFrame frame(bent_path({0.5, 3.0}, {70}), false);
  EXPECT_NEAR(frame.straight_length(), 0.5, 1e-14);
  const Vec2 x = frame.tip() + 0.49 * turned_left(frame.tangent());
  EXPECT_NEAR(frame.polar(x).theta, pi / 2, 1e-12);
}

TEST(TipFrameTest, KnowsWhereItBends) {
  EXPECT_TRUE(TipFrame(bent_path({3.0}, {}), false).bends().empty());
  const auto path = bent_path({0.4, 0.7, 3.0}, {70, -40});
  const auto bends = TipFrame(path, false).bends();
  ASSERT_EQ(bends.size(), 2u);
  EXPECT_NEAR(bends[0], 0.4, 1e-14);
  EXPECT_NEAR(bends[1], (path[2] - path[0]).norm(), 1e-14);
  EXPECT_TRUE(TipFrame(bent_path({1.0, 0.5, 2.0}, {0.0, 0.0}), false).bends().empty())
      << "growth straight on is no bend";
}

TEST(TipFrameTest, ReachesAsFarAsTheCrackGoesOn) {
  EXPECT_NEAR(TipFrame(bent_path({3.0}, {}), true).valid_radius(), 3.0, 1e-14);
  const auto bent = bent_path({1.0, 2.0}, {70});
  EXPECT_NEAR(TipFrame(bent, true).valid_radius(), (bent[2] - bent[0]).norm(), 1e-14);
  EXPECT_TRUE(std::isinf(TipFrame(bent, false).valid_radius())) << "ends on the rim or in a joint";
}

TEST(TipFrameTest, StopsWhereTheCrackTurnsBack) {
  EXPECT_NEAR(TipFrame(bent_path({1.0, 2.0}, {91}), false).valid_radius(), 1.0, 1e-14);
  const auto path = bent_path({1.0, 0.5, 3.0}, {60, 60});
  EXPECT_NEAR(TipFrame(path, false).valid_radius(), (path[2] - path[0]).norm(), 1e-14);
}

TEST(TipFrameTest, StopsWhereTheCrackHasGoneTooFarRound) {
  // every bend by 45 degrees leads away from the tip, but the last place is seen at more than 110
  const auto path = bent_path({1.0, 1.5, 4.0, 30.0, 300.0}, {45, 45, 45, 45});
  const double valid = TipFrame(path, false).valid_radius();
  EXPECT_TRUE(std::isfinite(valid));
  EXPECT_GE(valid, (path[3] - path[0]).norm() - 1e-12);
}

}  // namespace
}  // namespace cdca
