// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/gauss.hpp"
#include "core/cells/near_tip.hpp"
#include "core/cells/tip_quadrature.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <random>
#include <string>

namespace cdca {
namespace {

using Loop = std::vector<Vec2>;

const Loop unit_square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/// The element (1, 1) of a grid of 3 x 3, cut by cracks with two active ends. Grid coordinates.
struct Element {
  std::string name;
  std::vector<std::vector<Vec2>> cracks;

  std::vector<Crack> crack_list() const {
    std::vector<Crack> list;
    for (const auto& points : cracks) {
      Crack crack;
      crack.points = points;
      list.push_back(crack);
    }
    return list;
  }
  CutElement cut() const {
    const StructuredGrid grid(Vec2(0, 0), Vec2(3, 3), 3, 3);
    return cut_element(CrackPaths(grid, crack_list()), {1, 1});
  }
  /// Of the first crack, inside-the-element coordinates.
  Vec2 tip() const { return cracks.front().back() - Vec2(1, 1); }
};

std::ostream& operator<<(std::ostream& out, const Element& e) { return out << e.name; }

/// int x^a y^b over a polygon, by Green's theorem.
double moment(const Loop& loop, int a, int b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 d = loop[(k + 1) % loop.size()] - loop[k];
    for (const GaussPoint& g : gauss_points(10)) {
      const Vec2 x = loop[k] + g.x * d;
      sum += g.weight * d.y() * std::pow(x.x(), a + 1) / (a + 1) * std::pow(x.y(), b);
    }
  }
  return sum;
}

double integral(const std::vector<QuadraturePoint>& points,
                const std::function<double(const Vec2&)>& f) {
  double sum = 0.0;
  for (const QuadraturePoint& q : points) sum += q.weight * f(q.at);
  return sum;
}

void expect_moments(const CutElement& cut, int part, const std::vector<QuadraturePoint>& points,
                    int degree, double tolerance) {
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; a + b <= degree; ++b) {
      double expected = 0.0;
      for (const Loop& loop : loops_of(&cut, part)) expected += moment(loop, a, b);
      const auto f = [a, b](const Vec2& x) { return std::pow(x.x(), a) * std::pow(x.y(), b); };
      EXPECT_NEAR(integral(points, f), expected, tolerance) << "x^" << a << " y^" << b;
    }
}

TEST(GaussTest, IsExactUpToItsDegreeAndNoFurther) {
  for (int n = 1; n <= 20; ++n) {
    const auto points = gauss_points(n);
    ASSERT_EQ(points.size(), std::size_t(n));
    const auto error = [&points](int power) {
      double sum = 0.0;
      for (const GaussPoint& g : points) sum += g.weight * std::pow(g.x, power);
      return std::abs(sum - 1.0 / (power + 1));
    };
    for (int power = 0; power < 2 * n; ++power)
      EXPECT_LT(error(power), 1e-14) << n << ", " << power;
    if (n <= 5) {
      EXPECT_GT(error(2 * n), 1e-7);
    }
    for (const GaussPoint& g : points) EXPECT_TRUE(g.weight > 0 && g.x > 0 && g.x < 1);
  }
}

class QuadratureTest : public ::testing::TestWithParam<Element> {};

TEST_P(QuadratureTest, PlainPointsIntegrateQuadraticsExactly) {
  const CutElement cut = GetParam().cut();
  for (int part = 0; part < cut.parts; ++part)
    expect_moments(cut, part, plain_quadrature(&cut, part), 2, 1e-14);
}

TEST_P(QuadratureTest, SmoothPointsIntegratePolynomialsExactly) {
  const CutElement cut = GetParam().cut();
  for (int part = 0; part < cut.parts; ++part)
    expect_moments(cut, part, smooth_quadrature(&cut, part, 5), 8, 1e-13);
}

TEST_P(QuadratureTest, TipPointsIntegrateQuadraticsExactly) {
  const CutElement cut = GetParam().cut();
  for (int part = 0; part < cut.parts; ++part)
    expect_moments(cut, part, tip_quadrature(&cut, part, {{GetParam().tip()}}, Vec2(1, 2)), 2,
                   1e-12);
}

TEST_P(QuadratureTest, TrianglesCoverThePolygon) {
  for (const ElementPolygon& p : GetParam().cut().polygons) {
    double sum = 0.0;
    for (const auto& t : triangulate(p.loop)) {
      const double area = 0.5 * cross(t[1] - t[0], t[2] - t[0]);
      EXPECT_GE(area, -1e-15);
      sum += area;
    }
    EXPECT_NEAR(sum, p.area, 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cuts, QuadratureTest,
    ::testing::Values(Element{"straight", {{{0.5, 1.2}, {2.5, 1.6}}}},
                      Element{"zigzag",
                              {{{0.5, 1.2}, {1.2, 1.9}, {1.5, 1.1}, {1.7, 1.8}, {2.5, 1.5}}}},
                      Element{"hook", {{{0.5, 1.2}, {1.8, 1.2}, {1.8, 1.8}, {0.5, 1.6}}}},
                      Element{"tip_inside", {{{0.5, 1.2}, {1.4, 1.4}}}},
                      Element{"tip_behind_a_kink", {{{0.5, 1.2}, {1.4, 1.4}, {1.3, 1.7}}}},
                      Element{"crossing", {{{0.5, 1.3}, {2.5, 1.7}}, {{1.4, 0.5}, {1.5, 2.5}}}},
                      Element{"touching", {{{0.5, 1.3}, {2.5, 1.7}}, {{1.4, 2.5}, {1.5, 1.5}}}},
                      Element{"sliver", {{{0.51, 1.5}, {1.51, 0.5}}}},
                      Element{"along_a_side", {{{0.5, 1}, {1.5, 1}}}}),
    [](const auto& test) { return test.param.name; });

TEST(QuadratureOfAWholeElement, IsExactForTheStiffnessOfBilinearFunctions) {
  for (int a = 0; a <= 2; ++a)
    for (int b = 0; b <= 2; ++b) {
      const auto f = [a, b](const Vec2& x) { return std::pow(x.x(), a) * std::pow(x.y(), b); };
      EXPECT_NEAR(integral(plain_quadrature(nullptr, 0), f), 1.0 / ((a + 1) * (b + 1)), 1e-15);
      EXPECT_NEAR(integral(tip_quadrature(nullptr, 0, {{Vec2(9, 9)}}, Vec2(1, 1)), f),
                  1.0 / ((a + 1) * (b + 1)), 1e-14);
    }
}

TEST(TriangulateTest, SplitsPolygonsThatAreNotConvex) {
  const Loop comb{{0, 0}, {5, 0}, {5, 3}, {4, 1}, {3, 3}, {2, 1}, {1, 3}, {1, 1}, {0, 3}};
  double sum = 0.0;
  const auto triangles = triangulate(comb);
  EXPECT_EQ(triangles.size(), comb.size() - 2);
  for (const auto& t : triangles) {
    EXPECT_GT(cross(t[1] - t[0], t[2] - t[0]), 0.0);
    sum += 0.5 * cross(t[1] - t[0], t[2] - t[0]);
  }
  EXPECT_NEAR(sum, 10.0, 1e-13);
}

TEST(TriangulateTest, FansOutFromTheApexWherePossible) {
  const Vec2 apex(1, 0);
  for (const auto& t : triangulate(unit_square, &apex)) EXPECT_EQ(t[0], apex);
  const Loop arrow{{0, 0}, {2, 1}, {0, 2}, {0.5, 1}};  // (0, 0) does not see (0, 2)
  const Vec2 hidden(0, 0);
  double sum = 0.0;
  for (const auto& t : triangulate(arrow, &hidden)) {
    EXPECT_GT(cross(t[1] - t[0], t[2] - t[0]), 0.0);
    sum += 0.5 * cross(t[1] - t[0], t[2] - t[0]);
  }
  EXPECT_NEAR(sum, 1.5, 1e-14);
}

/// Reference for int r^p g(theta) over a polygon that the crack does not cross: r^p g is the
/// divergence of (x - tip) r^p g / (p + 2), whose flux through a side is its distance from the tip
/// times a smooth integral.
double polar_integral(const Loop& loop, const Vec2& tip, double p,
                      const std::function<double(const Vec2&)>& g) {
  constexpr int cells = 200;
  double sum = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 a = loop[k] - tip, d = loop[(k + 1) % loop.size()] - loop[k];
    const double distance = cross(a, d) / d.norm();
    if (std::abs(distance) < 1e-13) continue;
    for (int c = 0; c < cells; ++c)
      for (const GaussPoint& q : gauss_points(12)) {
        const Vec2 x = a + (c + q.x) / cells * d;
        sum += q.weight / cells * d.norm() * distance * std::pow(x.norm(), p) * g(x) / (p + 2);
      }
  }
  return sum;
}

/// Elements near the tip of a straight crack.
class TipQuadratureTest : public ::testing::TestWithParam<Element> {
 protected:
  TipQuadratureTest() {
    const auto& points = GetParam().cracks.front();
    tip_ = GetParam().tip().cwiseProduct(h_);
    tangent_ = (points[1] - points[0]).cwiseProduct(h_).normalized();
  }
  double theta(const Vec2& from_tip) const {
    return std::atan2(cross(tangent_, from_tip), tangent_.dot(from_tip));
  }
  std::vector<Loop> loops(int part) const {
    auto found = loops_of(&cut_, part);
    if (cut_.polygons.empty()) found = {unit_square};
    for (Loop& loop : found)
      for (Vec2& x : loop) x = x.cwiseProduct(h_);
    return found;
  }
  const Vec2 h_{0.8, 1.1};  ///< m
  CutElement cut_ = GetParam().cut();
  Vec2 tip_, tangent_;  ///< m
};

TEST_P(TipQuadratureTest, IntegratesTheProductsOfNearTipFunctions) {
  // stresses go with r^-1/2 and angles up to 5/2 theta; their products with r^-1 and 5 theta
  struct Product {
    double power;
    std::function<double(double)> angular;
  };
  const std::vector<Product> products{
      {-1.0, [](double) { return 1.0; }},
      {-1.0, [](double t) { return std::cos(t); }},
      {-1.0, [](double t) { return std::sin(2.5 * t) * std::sin(2.5 * t); }},
      {-0.5, [](double t) { return std::sin(0.5 * t); }},
      {-0.5, [](double t) { return std::cos(2.5 * t); }},
      {0.0, [](double t) { return std::sin(t) * std::cos(t / 2); }},
      {0.5, [](double t) { return std::sin(1.5 * t); }},
  };
  for (int part = 0; part < cut_.parts; ++part) {
    const auto points =
        tip_quadrature(cut_.polygons.empty() ? nullptr : &cut_, part, {{GetParam().tip()}}, h_);
    for (const Product& product : products) {
      const auto g = [&](const Vec2& x) { return product.angular(theta(x)); };
      double expected = 0.0;
      for (const Loop& loop : loops(part)) expected += polar_integral(loop, tip_, product.power, g);
      const double found = h_.prod() * integral(points, [&](const Vec2& p) {
                             const Vec2 x = p.cwiseProduct(h_) - tip_;
                             return std::pow(x.norm(), product.power) * g(x);
                           });
      EXPECT_NEAR(found, expected, 1e-9) << "r^" << product.power;
    }
  }
}

TEST_P(TipQuadratureTest, SatisfiesTheDivergenceTheoremForNearTipFunctions) {
  const TipFrame frame({tip_, tip_ - 10 * tangent_}, false);
  for (int part = 0; part < cut_.parts; ++part) {
    std::array<Vec2, 4> inside{}, outside{};
    for (std::size_t l = 0; l < 4; ++l) inside[l] = outside[l] = Vec2(0, 0);
    for (const QuadraturePoint& q :
         tip_quadrature(cut_.polygons.empty() ? nullptr : &cut_, part, {{GetParam().tip()}}, h_)) {
      const auto f = near_tip_functions(frame.polar(q.at.cwiseProduct(h_)));
      for (std::size_t l = 0; l < 4; ++l) inside[l] += q.weight * h_.prod() * f.gradient[l];
    }
    for (const Loop& loop : loops(part)) {
      Vec2 centre(0, 0);
      for (const Vec2& x : loop) centre += x / double(loop.size());
      const FaceSide face = theta(centre - tip_) > 0 ? FaceSide::plus : FaceSide::minus;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec2 a = loop[k], b = loop[(k + 1) % loop.size()];
        const bool on_crack = std::abs(theta(0.5 * (a + b) - tip_)) > 3.1415926;
        const Vec2 normal = -turned_left(b - a);  // outwards, times the length
        for (const QuadraturePoint& q : line_quadrature(a, b, {{tip_}})) {
          const auto f = near_tip_functions(frame.polar(q.at, on_crack ? face : FaceSide::none));
          for (std::size_t l = 0; l < 4; ++l) outside[l] += q.weight * f.value[l] * normal;
        }
      }
    }
    for (std::size_t l = 0; l < 4; ++l)
      EXPECT_LT((inside[l] - outside[l]).norm(), 1e-9) << "function " << l;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Tips, TipQuadratureTest,
    ::testing::Values(Element{"inside", {{{0.5, 1.3}, {1.4, 1.5}}}},
                      Element{"just_inside", {{{0.5, 1.3}, {1.002, 1.32}}}},
                      Element{"close_to_a_corner", {{{0.4, 0.5}, {1.03, 1.04}}}},
                      Element{"on_a_side", {{{0.5, 1.3}, {2, 1.6}}}},
                      Element{"on_a_corner", {{{0.5, 0.3}, {2, 2}}}},
                      Element{"in_the_next_element", {{{0.5, 1.2}, {2.2, 1.5}}}},
                      Element{"in_the_element_before", {{{0.2, 1.3}, {0.95, 1.4}}}},
                      Element{"on_the_side_of_an_untouched_element", {{{0.3, 1.3}, {1, 1.4}}}},
                      Element{"almost_on_the_side", {{{0.3, 1.3}, {1 - 1e-2, 1.4}}}},
                      Element{"almost_on_a_corner", {{{0.3, 0.3}, {1 - 1e-3, 1 - 2e-3}}}},
                      Element{"along_a_side", {{{0.5, 1}, {1.6, 1}}}}),
    [](const auto& test) { return test.param.name; });

TEST(TipQuadratureOfABentCrack, IntegratesPowersOfTheDistance) {
  const Element element{"", {{{0.5, 1.2}, {1.3, 1.3}, {1.5, 1.7}}}};
  const CutElement cut = element.cut();
  const auto points = tip_quadrature(&cut, 0, {{element.tip()}}, Vec2(1, 1));
  for (const double power : {-1.0, -0.5, 0.5}) {
    const double expected =
        polar_integral(unit_square, element.tip(), power, [](const Vec2&) { return 1.0; });
    EXPECT_NEAR(
        integral(points,
                 [&](const Vec2& p) { return std::pow((p - element.tip()).norm(), power); }),
        expected, 1e-9);
  }
}

/// The frame of a bent crack has kinks on circles round the tip; on the rim they are resolved by
/// short steps here.
TEST(TipQuadratureOfABentCrack, SatisfiesTheDivergenceTheorem) {
  const std::vector<Vec2> path{{1.55, 1.7}, {1.3, 1.3}, {0.5, 1.2}};
  const TipFrame frame(path, false);
  const StructuredGrid grid(Vec2(0, 0), Vec2(3, 3), 3, 3);
  const Element element{"", {{path[2], path[1], path[0]}}};
  const CrackPaths paths(grid, element.crack_list());
  for (const GridIndex e : {GridIndex{1, 1}, {0, 1}, {1, 2}, {2, 1}}) {
    const Vec2 corner(e.i, e.j);
    const CutElement cut = cut_element(paths, e);
    for (int part = 0; part < cut.parts; ++part) {
      Vec2 inside(0, 0), outside(0, 0);
      for (const QuadraturePoint& q :
           tip_quadrature(&cut, part, {{path[0] - corner, frame.bends()}}, Vec2(1, 1)))
        inside += q.weight * near_tip_functions(frame.polar(corner + q.at)).gradient[0];
      for (const Loop& loop : loops_of(&cut, part)) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
          const Vec2 a = corner + loop[k], d = loop[(k + 1) % loop.size()] - loop[k];
          const Vec2 normal = -turned_left(d), near = a + 0.5 * d - 1e-6 * normal;
          const FaceSide face = frame.polar(near).theta > 0 ? FaceSide::plus : FaceSide::minus;
          const bool on_crack = std::abs(frame.polar(a + 0.5 * d).theta) > 3.1415926;
          constexpr int cells = 400;
          for (int c = 0; c < cells; ++c)
            for (const GaussPoint& g : gauss_points(4)) {
              const Vec2 x = a + (c + g.x) / cells * d;
              const auto polar = frame.polar(x, on_crack ? face : FaceSide::none);
              outside += g.weight / cells * near_tip_functions(polar).value[0] * normal;
            }
        }
      }
      EXPECT_LT((inside - outside).norm(), 1e-4) << e.i << ", " << e.j << ", part " << part;
    }
  }
}

/// Wherever the tip is: in corners, on sides, in line with them, or next to nothing off any of
/// these.
TEST(TipQuadratureOfAnyTriangle, WeightsAddUpToItsArea) {
  std::mt19937 engine(5);
  const auto any = [&engine] { return double(engine()) / double(std::mt19937::max()); };
  int tried = 0;
  while (tried < 3000) {
    const Loop t{{any(), any()}, {any(), any()}, {any(), any()}};
    const double area = 0.5 * cross(t[1] - t[0], t[2] - t[0]);
    if (area < 1e-3) continue;
    CutElement cut;
    cut.parts = 2;
    cut.polygons.resize(2);
    cut.polygons[0].loop = t;
    cut.polygons[1].part = 1;
    const double along = 3 * any() - 1, off = std::pow(10.0, -16 * any());
    const std::vector<Vec2> places{
        t[0] + off * Vec2(any() - 0.5, any() - 0.5), t[0] + along * (t[1] - t[0]),
        t[0] + along * (t[1] - t[0]) + off * Vec2(any() - 0.5, any() - 0.5)};
    for (const Vec2& tip : places) {
      double sum = 0.0;
      for (const QuadraturePoint& q : tip_quadrature(&cut, 0, {{tip, {0.3 * any()}}}, Vec2(1, 1))) {
        EXPECT_GE(q.weight, 0.0);
        sum += q.weight;
      }
      EXPECT_NEAR(sum, area, 1e-9) << tip.transpose();
    }
    ++tried;
  }
}

TEST(TipQuadratureOfTwoTips, IntegratesBothSingularities) {
  const Element element{"", {{{0.5, 1.3}, {1.6, 1.3}}, {{2.5, 1.7}, {1.4, 1.7}}}};
  const CutElement cut = element.cut();
  const std::vector<SingularPlace> tips{{Vec2(0.6, 0.3)}, {Vec2(0.4, 0.7)}};
  const auto points = tip_quadrature(&cut, 0, tips, Vec2(1, 1));
  for (const SingularPlace& tip : tips) {
    const double expected =
        polar_integral(unit_square, tip.at, -1, [](const Vec2&) { return 1.0; });
    EXPECT_NEAR(integral(points, [&](const Vec2& p) { return 1 / (p - tip.at).norm(); }), expected,
                1e-9);
  }
}

TEST(LineQuadratureTest, WeightsAddUpToOneAndPlacesLieOnTheLine) {
  const Vec2 a(0.2, 0.9), b(0.7, 0.1);
  for (const Vec2& tip : {a, b, Vec2(0.45, 0.5), Vec2(0.5, 0.52), Vec2(9, 9)}) {
    double sum = 0.0;
    for (const QuadraturePoint& q : line_quadrature(a, b, {{tip}})) {
      sum += q.weight;
      EXPECT_LT(std::abs(cross(q.at - a, b - a)), 1e-14);
    }
    EXPECT_NEAR(sum, 1.0, 1e-13);
  }
}

TEST(LineQuadratureTest, IntegratesInverseRootsFromEitherEnd) {
  const Vec2 a(0.2, 0.9), b(0.7, 0.1);
  const double length = (b - a).norm();
  for (const Vec2& tip : {a, b}) {
    double sum = 0.0;
    for (const QuadraturePoint& q : line_quadrature(a, b, {{tip}}))
      sum += q.weight * length / std::sqrt((q.at - tip).norm());
    EXPECT_NEAR(sum, 2 * std::sqrt(length), 1e-12);
  }
}

TEST(LineQuadratureTest, IsGradedTowardsTipsBesideTheLine) {
  for (const double gap : {0.5, 1e-2, 1e-4}) {
    double sum = 0.0;
    const Vec2 tip(0.4, gap);
    for (const QuadraturePoint& q : line_quadrature(Vec2(0, 0), Vec2(1, 0), {{tip}}))
      sum += q.weight / (q.at - tip).norm();
    EXPECT_NEAR(sum, std::asinh(0.4 / gap) + std::asinh(0.6 / gap), 1e-9) << gap;
  }
}

}  // namespace
}  // namespace cdca
