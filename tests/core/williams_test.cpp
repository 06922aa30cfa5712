// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/williams.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>

namespace cdca {
namespace {

constexpr double pi = std::numbers::pi;

struct Case {
  int mode;
  bool plane_strain;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << "mode " << c.mode << (c.plane_strain ? ", plane strain" : ", plane stress");
}

class WilliamsTest : public ::testing::TestWithParam<Case> {
 protected:
  WilliamsField at(const Vec2& x) const {
    return williams_field(material_, GetParam().mode, x.norm(), std::atan2(x.y(), x.x()));
  }
  const Material material_{7.0, 0.3, GetParam().plane_strain};
  const std::vector<Vec2> places_{{0.3, 0.2}, {-0.4, 0.5}, {-0.7, -0.1}, {0.1, -0.9}, {2.0, 0.0}};
};

TEST_P(WilliamsTest, GradientIsThatOfTheDisplacement) {
  constexpr double h = 1e-6;
  for (const Vec2& x : places_) {
    const Eigen::Matrix2d gradient = at(x).gradient;
    for (int j = 0; j < 2; ++j) {
      Vec2 d(0, 0);
      d[j] = h;
      const Vec2 slope = (at(x + d).displacement - at(x - d).displacement) / (2 * h);
      EXPECT_LT((slope - gradient.col(j)).norm(), 1e-8);
    }
  }
}

TEST_P(WilliamsTest, StressIsThatOfTheGradient) {
  for (const Vec2& x : places_)
    EXPECT_LT((at(x).stress - material_.stress(at(x).gradient)).norm(), 1e-13);
}

TEST_P(WilliamsTest, IsInEquilibrium) {
  constexpr double h = 1e-5;
  for (const Vec2& x : places_) {
    const Voigt dx = (at(x + Vec2(h, 0)).stress - at(x - Vec2(h, 0)).stress) / (2 * h);
    const Voigt dy = (at(x + Vec2(0, h)).stress - at(x - Vec2(0, h)).stress) / (2 * h);
    EXPECT_NEAR(dx[0] + dy[2], 0.0, 1e-7);
    EXPECT_NEAR(dx[2] + dy[1], 0.0, 1e-7);
  }
}

TEST_P(WilliamsTest, FacesAreFreeOfTraction) {
  for (const double theta : {pi, -pi}) {
    const Voigt s = williams_field(material_, GetParam().mode, 0.37, theta).stress;
    EXPECT_NEAR(s[1], 0.0, 1e-15);
    EXPECT_NEAR(s[2], 0.0, 1e-15);
  }
}

TEST_P(WilliamsTest, HasUnitIntensity) {
  constexpr double r = 0.37;
  const Voigt ahead = williams_field(material_, GetParam().mode, r, 0.0).stress;
  const double unit = 1 / std::sqrt(2 * pi * r);
  const Voigt expected = GetParam().mode == 1 ? Voigt(unit, unit, 0) : Voigt(0, 0, unit);
  EXPECT_LT((ahead - expected).norm(), 1e-14);
}

TEST_P(WilliamsTest, FacesMoveApartAsIrwinHasIt) {
  constexpr double r = 0.37;
  const Vec2 jump = williams_field(material_, GetParam().mode, r, pi).displacement -
                    williams_field(material_, GetParam().mode, r, -pi).displacement;
  const double size = 8 / material_.fracture_modulus() * std::sqrt(r / (2 * pi));
  const Vec2 expected = GetParam().mode == 1 ? Vec2(0, size) : Vec2(size, 0);
  EXPECT_LT((jump - expected).norm(), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Modes, WilliamsTest,
                         ::testing::Values(Case{1, false}, Case{2, false}, Case{1, true},
                                           Case{2, true}));

TEST(MaterialTest, StretchingInPlaneStressNeedsNoSideForce) {
  const Material material{7.0, 0.3, false};
  const Voigt stress = material.elastic_matrix() * Voigt(1 / 7.0, -0.3 / 7.0, 0);
  EXPECT_LT((stress - Voigt(1, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(material.out_of_plane(stress), 0.0);
}

TEST(MaterialTest, PlaneStrainObeysHookeInThreeDimensions) {
  const Material material{7.0, 0.3, true};
  const double x = 1.0, y = -0.4, xy = 0.2, z = 0.3 * (x + y);  // z holds the third direction
  const Voigt strain((x - 0.3 * (y + z)) / 7, (y - 0.3 * (x + z)) / 7, xy / material.shear());
  const Voigt stress = material.elastic_matrix() * strain;
  EXPECT_LT((stress - Voigt(x, y, xy)).norm(), 1e-15);
  EXPECT_NEAR(material.out_of_plane(stress), z, 1e-15);
}

}  // namespace
}  // namespace cdca
