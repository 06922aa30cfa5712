// SPDX-License-Identifier: BSD-3-Clause
/// Linear elastic, isotropic material in the plane.
#pragma once

#include "core/cells/part_stiffness.hpp"

namespace cdca {

struct Material {
  double young = 1.0;  ///< Pa
  double poisson = 0.0;
  bool plane_strain = false;

  double shear() const { return young / (2 * (1 + poisson)); }
  /// Kolosov's constant.
  double kolosov() const { return plane_strain ? 3 - 4 * poisson : (3 - poisson) / (1 + poisson); }
  /// E' of K^2 = E' G: E in plane stress, E / (1 - nu^2) in plane strain.
  double fracture_modulus() const { return plane_strain ? young / (1 - poisson * poisson) : young; }
  ElasticMatrix elastic_matrix() const;
  /// (xx, yy, xy) in Pa from the displacement gradient.
  Voigt stress(const Eigen::Matrix2d& gradient) const;
  /// Stress out of the plane, Pa.
  double out_of_plane(const Voigt& stress) const {
    return plane_strain ? poisson * (stress[0] + stress[1]) : 0.0;
  }
};

}  // namespace cdca
