// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/part_stiffness.hpp"

#include "core/cells/tip_quadrature.hpp"
#include "core/mesh/shape_functions.hpp"

#include <algorithm>

namespace cdca {

namespace {

/// Two columns of B: the strain (xx, yy, 2 xy) of a function moved along x, and along y.
void set_strain_columns(Eigen::Ref<Eigen::Matrix<double, 3, 2>> b, const Vec2& gradient) {
  b << gradient.x(), 0, 0, gradient.y(), gradient.y(), gradient.x();
}

}  // namespace

namespace {

/// Integrals of products of derivatives of all functions: xx, xy, yy.
struct GradientProducts {
  Eigen::MatrixXd xx, xy, yy;
};

GradientProducts gradient_products(const PartBasis& basis, Eigen::Index count, const Vec2& h,
                                   const std::vector<QuadraturePoint>& points) {
  constexpr std::size_t batch = 256;  // large enough for fast products, small enough for the cache
  GradientProducts sum{Eigen::MatrixXd::Zero(count, count), Eigen::MatrixXd::Zero(count, count),
                       Eigen::MatrixXd::Zero(count, count)};
  Eigen::MatrixXd gx(count, batch), gy(count, batch), wx(count, batch), wy(count, batch);
  for (std::size_t start = 0; start < points.size(); start += batch) {
    const auto size = Eigen::Index(std::min(batch, points.size() - start));
    for (Eigen::Index q = 0; q < size; ++q) {
      const QuadraturePoint& point = points[start + std::size_t(q)];
      basis.evaluate_gradients(point.at, gx.col(q).data(), gy.col(q).data());
      wx.col(q) = point.weight * h.prod() * gx.col(q);
      wy.col(q) = point.weight * h.prod() * gy.col(q);
    }
    sum.xx.noalias() += wx.leftCols(size) * gx.leftCols(size).transpose();
    sum.xy.noalias() += wx.leftCols(size) * gy.leftCols(size).transpose();
    sum.yy.noalias() += wy.leftCols(size) * gy.leftCols(size).transpose();
  }
  return sum;
}

/// Lists the unknowns of the functions, each once. What a unit of each of them moves: x and y of
/// function 0, of function 1, and so on.
Eigen::MatrixXd directions_of(const std::vector<BasisFunction>& functions,
                              std::vector<LocalId>& unknowns) {
  for (const BasisFunction& f : functions) {
    if (std::find(unknowns.begin(), unknowns.end(), f.unknown) != unknowns.end()) continue;
    unknowns.insert(unknowns.end(), {f.unknown, f.unknown + 1});
  }
  Eigen::MatrixXd moved =
      Eigen::MatrixXd::Zero(2 * Eigen::Index(functions.size()), Eigen::Index(unknowns.size()));
  for (std::size_t k = 0; k < functions.size(); ++k) {
    const auto first = std::find(unknowns.begin(), unknowns.end(), functions[k].unknown);
    moved.block<2, 2>(2 * Eigen::Index(k), first - unknowns.begin()) = functions[k].columns();
  }
  return moved;
}

}  // namespace

PartStiffness part_stiffness(const BasisContext& context, GridIndex element, int part,
                             const ElasticMatrix& d) {
  const PartBasis basis(context, element, part);
  const CutElement* cut = context.cuts.find(element);
  const Vec2& h = context.mesh.grid().element_size();
  PartStiffness stiffness;
  const auto points = basis.has_tip_functions() ? tip_quadrature(cut, part, basis.tip_places(), h)
                                                : plain_quadrature(cut, part);
  std::vector<BasisFunction> functions;
  basis.evaluate(Vec2(0, 0), functions);
  const auto count = Eigen::Index(functions.size());
  const GradientProducts p = gradient_products(basis, count, h, points);
  // B^T D B for B = (N,x 0; 0 N,y; N,y N,x), block by block
  stiffness.matrix.resize(2 * count, 2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double xx = p.xx(i, j), xy = p.xy(i, j), yx = p.xy(j, i), yy = p.yy(i, j);
      stiffness.matrix(2 * i, 2 * j) = d(0, 0) * xx + d(2, 2) * yy;
      stiffness.matrix(2 * i, 2 * j + 1) = d(0, 1) * xy + d(2, 2) * yx;
      stiffness.matrix(2 * i + 1, 2 * j) = d(0, 1) * yx + d(2, 2) * xy;
      stiffness.matrix(2 * i + 1, 2 * j + 1) = d(1, 1) * yy + d(2, 2) * xx;
    }
  }
  const Eigen::MatrixXd of_unknowns = directions_of(functions, stiffness.unknowns);
  if (of_unknowns.cols() < of_unknowns.rows())
    stiffness.matrix = of_unknowns.transpose() * stiffness.matrix * of_unknowns;
  return stiffness;
}

Eigen::Matrix<double, 8, 8> plain_stiffness(const Vec2& h, const ElasticMatrix& elastic) {
  Eigen::Matrix<double, 8, 8> matrix = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 3, 8> b;
  for (const QuadraturePoint& q : plain_quadrature(nullptr, 0)) {
    const ShapeValues n = shape_functions(q.at, h);
    for (Eigen::Index a = 0; a < 4; ++a) {
      set_strain_columns(b.middleCols<2>(2 * a), n.gradient[std::size_t(a)]);
    }
    matrix += q.weight * h.prod() * b.transpose() * elastic * b;
  }
  return matrix;
}

}  // namespace cdca
