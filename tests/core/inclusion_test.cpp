// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/part_basis.hpp"
#include "core/cracks/crack_registry.hpp"
#include "core/cracks/level_set.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace cdca {
namespace {

using Function = std::function<double(const Vec2&)>;
using Matrix = Eigen::MatrixXd;

/// A body of nx by ny elements of size one, and the functions of its pieces.
class Body {
 public:
  Body(int nx, int ny, const std::vector<std::vector<Vec2>>& cracks, double tip_radius = 0.0)
      : grid_(Vec2(0, 0), Vec2(nx, ny), nx, ny), mesh_(grid_, BlockPartition(), 0) {
    for (const auto& points : cracks) registry_.add("", points);
    registry_.resolve_initial_meetings({Vec2(0, 0), Vec2(nx, ny)}, 1e-3);
    cuts_ = ElementCuts(grid_, CrackPaths(grid_, registry_.cracks()));
    zones_ = find_tip_zones(cuts_, registry_.cracks(), {tip_radius, 2.0, 0.0});
    unknowns_ = CellUnknowns(mesh_, cuts_, zones_, alone_);
    std::mt19937 random(17);
    std::uniform_real_distribution<double> any(0, 1);
    for (int k = 0; k < 80 * nx * ny; ++k) places_.emplace_back(nx * any(random), ny * any(random));
  }
  const StructuredGrid& grid() const { return grid_; }
  const ElementCuts& cuts() const { return cuts_; }
  /// Values of all functions at a place of a part, on its rim as well.
  Eigen::VectorXd values(GridIndex e, int part, const Vec2& x) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(functions());
    std::vector<BasisFunction> at;
    PartBasis({mesh_, cuts_, zones_, unknowns_}, e, part).evaluate(x - Vec2(e.i, e.j), at);
    for (const BasisFunction& f : at) sum[f.unknown / 2] += f.value;
    return sum;
  }
  const Crack& crack(std::size_t c) const { return registry_.cracks()[c]; }
  int functions() const { return unknowns_.owned() / 2; }
  int cells_with(int pieces) const {
    int count = 0;
    for (LocalId n = 0; n < mesh_.node_count(); ++n) count += unknowns_.pieces(n) == pieces;
    return count;
  }

  /// One column per function of the pieces (and near-tip function), one row per place.
  Matrix of_pieces() const {
    Matrix matrix(Eigen::Index(places_.size()), functions());
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const GridIndex e = grid_.element_at(places_[k]);
      matrix.row(Eigen::Index(k)) = values(e, cuts_.part_at(e, places_[k]), places_[k]);
    }
    return matrix;
  }

  /// N_k of all nodes, then N_k (E - E(x_k)) of all nodes for each E: Eq. 4 where E is H.
  Matrix of_paper(const std::vector<Function>& enrichments) const {
    std::vector<Function> columns;
    for (GlobalId id = 0; id < grid_.node_count(); ++id) {
      const GridIndex n = grid_.node_index(id);
      columns.push_back([this, n](const Vec2& x) { return hat(n, x); });
      for (const Function& e : enrichments) {
        const double at_node = e(grid_.node_position(n));
        columns.push_back(
            [this, n, e, at_node](const Vec2& x) { return hat(n, x) * (e(x) - at_node); });
      }
    }
    return sample(columns);
  }
  Matrix sample(const std::vector<Function>& columns) const {
    Matrix values(Eigen::Index(places_.size()), Eigen::Index(columns.size()));
    for (std::size_t k = 0; k < places_.size(); ++k)
      for (std::size_t c = 0; c < columns.size(); ++c)
        values(Eigen::Index(k), Eigen::Index(c)) = columns[c](places_[k]);
    return values;
  }
  double hat(GridIndex n, const Vec2& x) const {
    const Vec2 d = (x - grid_.node_position(n)).cwiseAbs();
    return std::max(0.0, 1 - d.x()) * std::max(0.0, 1 - d.y());
  }

 private:
  StructuredGrid grid_;
  LocalMesh mesh_;
  CrackRegistry registry_;
  ElementCuts cuts_;
  std::vector<TipZone> zones_;
  SerialCommunicator alone_;
  CellUnknowns unknowns_;
  std::vector<Vec2> places_;
};

Eigen::Index rank_of(const Matrix& m) {
  Eigen::ColPivHouseholderQR<Matrix> qr(m);
  qr.setThreshold(1e-9);
  return qr.rank();
}

Eigen::Index rank_of(const Matrix& a, const Matrix& b) {
  Matrix both(a.rows(), a.cols() + b.cols());
  both << a, b;
  return rank_of(both);
}

/// H of a crack: the sign of its level set.
Function heaviside(const Crack& crack) {
  return [&crack](const Vec2& x) { return LevelSet(crack).distance(x) < 0 ? -1.0 : 1.0; };
}

void expect_same_space(const Matrix& pieces, const Matrix& paper, int functions) {
  EXPECT_EQ(rank_of(pieces), functions) << "the pieces are linearly independent";
  EXPECT_EQ(rank_of(paper), functions);
  EXPECT_EQ(rank_of(pieces, paper), functions);
}

TEST(InclusionTest, WithoutCracksThereAreTheShapeFunctions) {
  const Body body(3, 3, {});
  EXPECT_EQ(body.functions(), 16);
  expect_same_space(body.of_pieces(), body.of_paper({}), 16);
}

TEST(InclusionTest, OneStraightCrackIsTheHeavisideEnrichment) {
  const Body body(3, 3, {{{0, 1.3}, {3, 1.8}}});
  EXPECT_EQ(body.functions(), 16 + 8);
  expect_same_space(body.of_pieces(), body.of_paper({heaviside(body.crack(0))}), 24);
}

TEST(InclusionTest, OneKinkedCrackIsTheHeavisideEnrichment) {
  const Body body(3, 3, {{{0, 1.3}, {1.4, 1.7}, {1.6, 1.2}, {3, 2.3}}});
  expect_same_space(body.of_pieces(), body.of_paper({heaviside(body.crack(0))}), body.functions());
}

/// Eq. 21-22: besides H of both cracks there is J^m, which is H of the crack m on the side A of the
/// crack M where m lies, and H of M on the other side B; each less its value for the node.
Matrix with_junction(const Body& body, const Function& major, const Function& minor,
                     double side_a) {
  std::vector<Function> columns;
  for (GlobalId id = 0; id < body.grid().node_count(); ++id) {
    const GridIndex n = body.grid().node_index(id);
    const Vec2 x_k = body.grid().node_position(n);
    columns.push_back([&body, n](const Vec2& x) { return body.hat(n, x); });
    columns.push_back(
        [&body, n, x_k, major](const Vec2& x) { return body.hat(n, x) * (major(x) - major(x_k)); });
    columns.push_back([&body, n, x_k, major, minor, side_a](const Vec2& x) {
      const bool in_a = major(x) == side_a;
      return body.hat(n, x) * (in_a ? minor(x) - minor(x_k) : major(x) - major(x_k));
    });
  }
  return body.sample(columns);
}

TEST(InclusionTest, TJunctionHoldsTheJunctionFunctions) {
  const Body body(3, 3, {{{0, 1.3}, {3, 1.7}}, {{1.6, 3}, {1.5, 1.5}}});
  EXPECT_GE(body.cells_with(3), 4);
  const Matrix paper = with_junction(body, heaviside(body.crack(0)), heaviside(body.crack(1)),
                                     1.0);  // m comes from above
  expect_same_space(body.of_pieces(), paper, body.functions());
}

TEST(InclusionTest, YJunctionHoldsTheJunctionFunctions) {
  const Vec2 joint(1.45, 1.55);
  const Body body(3, 3, {{{0, 1.2}, joint}, {{3, 1.3}, joint}, {{1.7, 3}, joint}});
  EXPECT_GE(body.cells_with(3), 4);
  Crack major;  // two of the three as one crack
  major.points = {{0, 1.2}, joint, {3, 1.3}};
  const Matrix paper = with_junction(body, heaviside(major), heaviside(body.crack(2)), 1.0);
  expect_same_space(body.of_pieces(), paper, body.functions());
}

TEST(InclusionTest, CrossingIsRicherThanTwoHeavisideFunctions) {
  const Body body(3, 3, {{{0, 1.3}, {3, 1.7}}, {{1.6, 0}, {1.4, 3}}});
  const Function one = heaviside(body.crack(0)), other = heaviside(body.crack(1));
  const int crossed = body.cells_with(4);
  EXPECT_GE(crossed, 4);
  const Matrix pieces = body.of_pieces(), two = body.of_paper({one, other});
  EXPECT_EQ(rank_of(pieces), body.functions());
  EXPECT_EQ(rank_of(two), body.functions() - crossed) << "one short in every crossed cell";
  EXPECT_EQ(rank_of(pieces, two), body.functions()) << "but nothing that the pieces lack";
  const Function product = [&](const Vec2& x) { return one(x) * other(x); };
  expect_same_space(pieces, body.of_paper({one, other, product}), body.functions());
}

/// Eq. 5 for a straight crack along x.
double near_tip(std::size_t l, const Vec2& tip, const Vec2& x) {
  const Vec2 d = x - tip;
  const double t = std::atan2(d.y(), d.x()), s = std::sin(t / 2), c = std::cos(t / 2);
  return std::sqrt(d.norm()) * std::array<double, 4>{s, c, std::sin(t) * s, std::sin(t) * c}[l];
}

/// The functions of a crack along y = 1.45 with its tip in the element (2, 1) of 5 x 3; where
/// `reached` is false, near-tip functions do not act.
std::vector<Function> with_tip(const Body& body, const Vec2& tip,
                               const std::function<bool(const Vec2&)>& reached) {
  std::vector<Function> columns;
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i <= 5; ++i) {
      const GridIndex n{i, j};
      const Vec2 x_n(i, j);
      columns.push_back([&body, n](const Vec2& x) { return body.hat(n, x); });
      const bool beside = j == 1 || j == 2;
      if (beside && i < 2) {  // the crack runs through the whole support
        const Function h = heaviside(body.crack(0));
        columns.push_back(
            [&body, n, h, x_n](const Vec2& x) { return body.hat(n, x) * (h(x) - h(x_n)); });
      }
      for (std::size_t l = 0; l < 4 && beside && (i == 2 || i == 3); ++l)
        columns.push_back([&body, n, l, tip, x_n, reached](const Vec2& x) {
          return reached(x) ? body.hat(n, x) * (near_tip(l, tip, x) - near_tip(l, tip, x_n)) : 0.0;
        });
    }
  return columns;
}

TEST(InclusionTest, TipHasTheNearTipEnrichment) {
  const Vec2 tip(2.6, 1.45);
  const Body body(5, 3, {{{0, 1.45}, tip}});
  EXPECT_EQ(body.functions(), 24 + 4 + 4 * 4);
  const auto columns = with_tip(body, tip, [](const Vec2&) { return true; });
  expect_same_space(body.of_pieces(), body.sample(columns), body.functions());
}

TEST(InclusionTest, NearTipFunctionsDoNotActAcrossAnotherCrack) {
  const Vec2 tip(2.6, 1.45);
  const Body body(5, 3, {{{0, 1.45}, tip}, {{2.9, 0}, {2.9, 3}}});
  auto columns = with_tip(body, tip, [](const Vec2& x) { return x.x() < 2.9; });
  const Function h = heaviside(body.crack(1));
  for (int j = 0; j <= 3; ++j)
    for (const int i : {2, 3}) {
      const double at_node = h(Vec2(i, j));
      columns.push_back([&body, i, j, h, at_node](const Vec2& x) {
        return body.hat({i, j}, x) * (h(x) - at_node);
      });
    }
  expect_same_space(body.of_pieces(), body.sample(columns), body.functions());
}

/// Functions agree on both sides of every open stretch between two elements.
double largest_jump(const Body& body) {
  double largest = 0.0;
  const auto compare = [&](GridIndex e, std::size_t side, GridIndex next, Vec2 start, Vec2 along) {
    if (!body.grid().has_element(next)) return;
    for (const SideContact& c :
         contacts(body.cuts().side(e, side), body.cuts().side(next, (side + 2) % 4))) {
      if (!c.open) continue;
      for (const double t : {0.1, 0.5, 0.9}) {
        const Vec2 x = start + (c.t0 + t * (c.t1 - c.t0)) * along;
        const Eigen::VectorXd jump = body.values(e, c.first, x) - body.values(next, c.second, x);
        largest = std::max(largest, jump.cwiseAbs().maxCoeff());
      }
    }
  };
  for (GlobalId id = 0; id < body.grid().element_count(); ++id) {
    const GridIndex e = body.grid().element_index(id);
    compare(e, 1, {e.i + 1, e.j}, Vec2(e.i + 1, e.j), Vec2(0, 1));
    compare(e, 2, {e.i, e.j + 1}, Vec2(e.i, e.j + 1), Vec2(1, 0));
  }
  return largest;
}

TEST(ContinuityTest, FunctionsDoNotJumpBetweenElements) {
  const std::vector<std::vector<Vec2>> kinked{
      {{0, 2.3}, {2.4, 2.2}, {2.75, 3.2}}};  // by 70 degrees
  for (const double tip_radius : {0.0, 1.2, 2.5}) {
    EXPECT_LT(largest_jump(Body(6, 6, kinked, tip_radius)), 1e-9);
    EXPECT_LT(largest_jump(Body(6, 6, {{{0, 3}, {2.5, 3}}, {{3, 6}, {3, 3.4}}}, tip_radius)), 1e-9);
  }
}

TEST(ContinuityTest, FunctionsOfRandomCracksDoNotJumpBetweenElements) {
  std::mt19937 random(59);
  std::uniform_real_distribution<double> any(0.1, 4.9);
  for (int k = 0; k < 120; ++k) {
    std::vector<std::vector<Vec2>> cracks(1 + std::size_t(k % 3));
    for (auto& points : cracks)
      for (int n = 0; n < 2 + k % 2; ++n) points.emplace_back(any(random), any(random));
    EXPECT_LT(largest_jump(Body(5, 5, cracks, k % 4 == 0 ? 1.2 : 0.0)), 1e-9) << "case " << k;
  }
}

}  // namespace
}  // namespace cdca
