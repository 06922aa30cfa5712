// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/material.hpp"

namespace cdca {

ElasticMatrix Material::elastic_matrix() const {
  const double e = fracture_modulus();
  const double nu = plane_strain ? poisson / (1 - poisson) : poisson;
  ElasticMatrix d;
  d << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  return e / (1 - nu * nu) * d;
}

Voigt Material::stress(const Eigen::Matrix2d& g) const {
  return elastic_matrix() * Voigt(g(0, 0), g(1, 1), g(0, 1) + g(1, 0));
}

}  // namespace cdca
