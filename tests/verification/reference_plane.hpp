// SPDX-License-Identifier: BSD-3-Clause
/// A rectangle that answers as if it were cut out of an infinite plane with all its cracks inside.
#pragma once

#include "tests/plates.hpp"

#include <vector>

namespace cdca::testing {

/// Displacements on the rim of the rectangle: those of the uniform stress far away, and what the
/// jumps over the crack faces add to them in an infinite plane,
///
///     u_k(x) = E_kl x_l + int over cracks of [u_i] S_ijk n_j ds          (Somigliana's formula),
///
/// (or those of another field far away), S_ijk(xi - x) the stress at xi of a unit force at x in
/// direction k (Kelvin), n from the minus to the plus face. The jumps are those of the model
/// itself: solve, take them, and solve again, until nothing changes (Aitken's relaxation saves half
/// of the solves). What is then found holds for the infinite plane, however small the rectangle.
class PlaneRim {
 public:
  PlaneRim(const Material& material, const Voigt& far_stress);
  /// far: displacements without cracks.
  PlaneRim(const Material& material, Field far);
  PlaneRim(const PlaneRim&) = delete;
  PlaneRim& operator=(const PlaneRim&) = delete;

  /// Holds the rim of the case at these displacements. Borrows this object.
  void hold(CaseSpec& spec) const;
  /// Goes on from the jumps over the crack faces of the model, solved with this rim.
  void take_jumps(const Model& model);
  Vec2 displacement(const Vec2& x) const;

  /// A short straight bit of crack: its middle, n times its length, and u on the plus face (where n
  /// points) less u on the minus face.
  struct Jump {
    Vec2 at{0, 0};
    Vec2 normal{0, 0};
    Vec2 jump{0, 0};
  };
  void set_jumps(std::vector<Jump> jumps) { jumps_ = std::move(jumps); }

 private:
  void relax(std::vector<Jump> solved);

  double poisson_;  ///< of plane strain; in plane stress the one that gives the same plane field
  Field far_;
  std::vector<Jump> jumps_;
  std::vector<Vec2> change_;  ///< of the last jumps
  double relaxation_ = 1.0;
};

/// Displacements of a plane with sigma_yy = slope x.
Field sloping_tension(const Material& material, double slope);

}  // namespace cdca::testing
