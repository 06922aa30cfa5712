// SPDX-License-Identifier: BSD-3-Clause
/// Distance of a computed field from an exact one.
#pragma once

#include "core/cells/tip_quadrature.hpp"
#include "tests/plates.hpp"

#include <cmath>

namespace cdca::testing {

struct ExactField {
  Field displacement;
  std::function<Eigen::Matrix2d(const Vec2&)> gradient;
};

struct FieldErrors {
  double energy = 0.0;  ///< sqrt of the strain energy of the difference
  double l2 = 0.0;      ///< of the displacement
};

/// `singular`: places (m) towards which the quadrature is graded.
inline FieldErrors errors_of(const Model& model, const ExactField& exact,
                             const std::vector<Vec2>& singular) {
  const StructuredGrid& grid = model.grid();
  double energy = 0.0, l2 = 0.0;
  std::vector<BasisFunction> functions;
  for (LocalId k = 0; k < model.mesh().element_count(); ++k) {
    const GridIndex e = model.mesh().element(k);
    if (!model.mesh().evaluates(e)) continue;
    std::vector<SingularPlace> places;
    for (const Vec2& x : singular) places.push_back({grid.to_grid(x) - Vec2(e.i, e.j), {}});
    for (int part = 0; part < model.cuts().parts(e); ++part) {
      const PartBasis basis(model.basis(), e, part);
      for (const auto& q : tip_quadrature(model.cuts().find(e), part, places, grid.element_size(),
                                          orders_of_loads)) {
        basis.evaluate(q.at, functions);
        const FieldValue u = field_value(functions, model.state());
        const Vec2 x = grid.from_grid(Vec2(e.i, e.j) + q.at);
        const double w = q.weight * grid.element_size().prod();
        const Eigen::Matrix2d d = u.gradient - exact.gradient(x);
        const Voigt strain(d(0, 0), d(1, 1), d(0, 1) + d(1, 0));
        energy += 0.5 * w * strain.dot(model.material().elastic_matrix() * strain);
        l2 += w * (u.displacement - exact.displacement(x)).squaredNorm();
      }
    }
  }
  return {std::sqrt(model.communicator().sum(energy)), std::sqrt(model.communicator().sum(l2))};
}

}  // namespace cdca::testing
