// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/tip_functions.hpp"

#include "core/cells/gauss.hpp"
#include "core/mesh/shape_functions.hpp"

#include <Eigen/Cholesky>

#include <cstddef>

namespace cdca {

Eigen::Matrix4d orthonormal_tip_functions(const StructuredGrid& grid, GridIndex node,
                                          const TipFrame& frame) {
  const Vec2& h = grid.element_size();
  const auto at_node = near_tip_functions(frame.polar(grid.node_position(node))).value;
  const auto elements = grid.elements_round(node);
  Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
  for (std::size_t slot = 0; slot < 4; ++slot) {
    if (!grid.has_element(elements[slot])) continue;
    const Vec2 corner = grid.node_position({elements[slot].i, elements[slot].j});
    const std::size_t own = (slot + 2) % 4;  // the cell's corner of this element
    for (const GaussPoint& x : gauss_points(4)) {
      for (const GaussPoint& y : gauss_points(4)) {
        const Vec2 p(x.x, y.x);
        const ShapeValues n = shape_functions(p, h);
        const auto f = near_tip_functions(frame.polar(corner + p.cwiseProduct(h)));
        Eigen::Matrix<double, 2, 4> gradients;
        for (std::size_t l = 0; l < 4; ++l)
          gradients.col(Eigen::Index(l)) =
              (f.value[l] - at_node[l]) * n.gradient[own] + n.value[own] * f.gradient[l];
        products += x.weight * y.weight * h.prod() * gradients.transpose() * gradients;
      }
    }
  }
  // products = L L^T: the columns of L^-T are what Gram and Schmidt's method makes of them
  const Eigen::LLT<Eigen::Matrix4d> factor(products);
  return factor.matrixU().solve(Eigen::Matrix4d::Identity());
}

}  // namespace cdca
