// SPDX-License-Identifier: BSD-3-Clause
/// The interaction integral as a linear form of the displacements.
#pragma once

#include "core/base/content_cache.hpp"
#include "core/cells/part_basis.hpp"
#include "core/mechanics/material.hpp"

#include <array>
#include <vector>

namespace cdca {

/// Where the integral of one tip is taken.
struct IntegralDomain {
  const TipZone& zone;
  double radius = 0.0;             ///< m
  std::array<bool, 4> held_sides;  ///< by Side: their tractions are those of the field

  /// Behind the tip the near-tip field leaves the faces free, as far as the crack is straight.
  bool on_straight_part(const StructuredGrid& grid, const CrackFace& face) const;
  /// Side of the tip's crack that a face lies on; plus: it is the crack's plus face.
  FaceSide side_of(const CrackFace& face, bool plus) const;
  /// First row: the tip's tangent; second: to its left.
  Eigen::Matrix2d axes() const;
};

/// What every unknown of an element adds to M of modes I and II (columns), N/m per metre of
/// thickness: by part, and within a part in the order of PartBasis::unknowns(), x and y each.
using ElementWeights = std::vector<Eigen::MatrixX2d>;

/// They do not depend on the loads, and change only where a crack or a tip near the element does.
class IntensityCache {
 public:
  void begin_cycle() { weights_.begin_cycle(); }
  /// bases: of the parts of the element.
  const ElementWeights& of(const BasisContext& context, GridIndex element,
                           const std::vector<PartBasis>& bases, const IntegralDomain& domain,
                           const Material& material);

 private:
  static constexpr int cycles_of_a_step = 4;  ///< as of part matrices
  ContentCache<ElementWeights> weights_{cycles_of_a_step};
};

}  // namespace cdca
