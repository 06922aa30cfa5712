// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/part_stiffness.hpp"

#include "core/cells/quadrature.hpp"
#include "core/mesh/shape_functions.hpp"

namespace cdca {

namespace {

/// Two columns of B: the strain (xx, yy, 2 xy) of a function moved along x, and along y.
void set_strain_columns(Eigen::Ref<Eigen::Matrix<double, 3, 2>> b, const Vec2& gradient) {
  b << gradient.x(), 0, 0, gradient.y(), gradient.y(), gradient.x();
}

}  // namespace

PartStiffness part_stiffness(const BasisContext& context, GridIndex element, int part,
                             const ElasticMatrix& elastic) {
  const PartBasis basis(context, element, part);
  const CutElement* cut = context.cuts.find(element);
  const Vec2& h = context.mesh.grid().element_size();
  PartStiffness stiffness;
  for (const LocalId first : basis.unknowns()) {
    stiffness.unknowns.push_back(first);
    stiffness.unknowns.push_back(first + 1);
  }
  const auto size = Eigen::Index(stiffness.unknowns.size());
  stiffness.matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::Matrix<double, 3, Eigen::Dynamic> b(3, size);
  Eigen::Matrix<double, 3, Eigen::Dynamic> stress(3, size);
  std::vector<BasisFunction> functions;
  const auto points = basis.has_tip_functions() ? tip_quadrature(cut, part, basis.tip_places(), h)
                                                : plain_quadrature(cut, part);
  for (const QuadraturePoint& q : points) {
    basis.evaluate(q.at, functions);
    for (std::size_t k = 0; k < functions.size(); ++k) {
      set_strain_columns(b.middleCols<2>(2 * Eigen::Index(k)), functions[k].gradient);
    }
    stress.noalias() = q.weight * h.prod() * elastic * b;
    stiffness.matrix.noalias() += b.transpose() * stress;
  }
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
