// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/tip_functions.hpp"

#include "tests/plates.hpp"

#include <Eigen/SVD>
#include <gtest/gtest.h>

namespace cdca::testing {
namespace {

/// Products of the gradients of a cell's near-tip functions, integrated over the whole cell.
Eigen::Matrix4d products_of(const Model& model, LocalId node, const TipUnknowns& tip, int points) {
  const StructuredGrid& grid = model.grid();
  Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
  std::vector<BasisFunction> functions;
  for (const GridIndex e : grid.elements_round(model.mesh().node(node))) {
    for (int part = 0; part < model.cuts().parts(e); ++part) {
      const PartBasis basis(model.basis(), e, part);
      for (const QuadraturePoint& q : smooth_quadrature(model.cuts().find(e), part, points)) {
        basis.evaluate(q.at, functions);
        Eigen::Matrix<double, 2, 4> own = Eigen::Matrix<double, 2, 4>::Zero();
        for (const BasisFunction& f : functions) {
          if (f.unknown >= tip.first && f.unknown < tip.first + tip.count)
            own.col((f.unknown - tip.first) / 2) = f.gradient;
        }
        products += q.weight * grid.element_size().prod() * own.transpose() * own;
      }
    }
  }
  return products;
}

/// A crack that ends in the middle of a plate of 41 x 41 elements.
std::unique_ptr<Model> cracked(double tip_radius) {
  CaseSpec spec = plate({0, 0}, {41, 41}, 41, 41);
  add_crack(spec, {{0, 20.4}, {20.3, 20.7}});
  spec.tip_radius = tip_radius;
  pull(spec, {0, 1, 0});
  return built(spec);
}

TEST(TipFunctions, AreOrthonormalInEveryCellAwayFromTheCrack) {
  const auto model = cracked(15.0);
  int cells = 0;
  for (const LocalId n : model->unknowns().special_nodes()) {
    const Vec2 way = model->grid().node_position(model->mesh().node(n)) - Vec2(20.3, 20.7);
    if (way.norm() < 3.0 || model->unknowns().pieces(n) > 1) continue;
    if (way.x() < 0.0 && std::abs(way.y()) < 2.0) continue;  // an element of it may be cut
    for (const TipUnknowns& tip : model->unknowns().tips(n)) {
      const Eigen::Matrix4d products = products_of(*model, n, tip, 6);
      EXPECT_LT((products - Eigen::Matrix4d::Identity()).norm(), 0.02) << way.transpose();
      ++cells;
    }
  }
  EXPECT_GT(cells, 500);
}

/// Near the tip, on the rim, and as far away as no zone reaches.
TEST(TipFunctions, SpanThoseOfTheEquation) {
  const StructuredGrid grid(Vec2(0, 0), Vec2(3000, 41), 3000, 41);
  const TipFrame frame({Vec2(20.3, 20.7), Vec2(12, 20.4), Vec2(0, 25)}, false);
  for (const GridIndex node :
       {GridIndex{20, 20}, {21, 22}, {18, 21}, {0, 41}, {40, 3}, {1000, 9}, {3000, 41}}) {
    const Eigen::Matrix4d t = orthonormal_tip_functions(grid, node, frame);
    ASSERT_TRUE(t.allFinite());
    const Eigen::JacobiSVD<Eigen::Matrix4d> values(t);
    EXPECT_GT(values.singularValues()[3], 1e-9 * values.singularValues()[0]);
  }
}

}  // namespace
}  // namespace cdca::testing
