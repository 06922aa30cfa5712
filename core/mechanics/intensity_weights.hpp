// SPDX-License-Identifier: BSD-3-Clause
/// The interaction integral as a linear form of the displacements.
#pragma once

#include "core/base/content_cache.hpp"
#include "core/cells/part_basis.hpp"
#include "core/mechanics/material.hpp"

#include <array>
#include <functional>
#include <map>
#include <tuple>
#include <vector>

namespace cdca {

class ContactPatches;
class DomainWeight;

/// Where the integral of one tip is taken.
struct IntegralDomain {
  const TipZone& zone;
  double radius = 0.0;             ///< m
  std::array<bool, 4> held_sides;  ///< by Side: their tractions are those of the field

  /// Calls visit(element, weight) for all elements in it that this rank evaluates.
  void for_each_element(const LocalMesh& mesh,
                        const std::function<void(GridIndex, const DomainWeight&)>& visit) const;
  /// Behind the tip the near-tip field leaves the faces free, as far as the crack is straight.
  bool on_straight_part(const StructuredGrid& grid, const CrackFace& face) const;
  /// Side of the tip's crack that a face lies on; plus: it is the crack's plus face.
  FaceSide side_of(const CrackFace& face, bool plus) const;
  /// First row: the tip's tangent; second: to its left.
  Eigen::Matrix2d axes() const;

  /// Takes w t_i u'_i,1 of modes I and II off m. t: traction at x (m) on that side, Pa.
  void take_off(const Material& material, const Vec2& x, FaceSide side, double w, const Vec2& t,
                double m[2]) const;
  /// Calls visit(x, side, w) for all points of one side of a face in an element, w with q.
  void for_face_points(const StructuredGrid& grid, GridIndex element, const CrackFace& face,
                       bool plus, const DomainWeight& q,
                       const std::function<void(const Vec2&, FaceSide, double)>& visit) const;
};

/// What every unknown of an element adds to M of modes I and II (columns), N/m per metre of
/// thickness: by part, and within a part in the order of PartBasis::unknowns(), x and y each.
using ElementWeights = std::vector<Eigen::MatrixX2d>;

/// They do not depend on the loads, and change only where a crack or a tip near the element does.
class IntensityCache {
 public:
  /// What one unknown adds to M of modes I and II.
  struct Weight {
    LocalId unknown;
    double mode_1, mode_2;
  };
  /// What tractions of 1 Pa along x and y on the plus face of a patch, and against it on the minus
  /// face, add.
  struct PatchWeight {
    std::size_t patch;
    Vec2 mode_1{0, 0}, mode_2{0, 0};
  };
  /// Of all elements in the domain of a tip that this rank evaluates.
  struct OfTip {
    std::vector<Weight> displacements;
    std::vector<PatchWeight> patches;
  };
  /// To be called when cracks, patches or unknowns change.
  void begin_cycle() {
    weights_.begin_cycle();
    tips_.clear();
  }
  /// contact: patches of faces that may touch; null for none.
  const OfTip& of(const BasisContext& context, const IntegralDomain& domain,
                  const Material& material, const ContactPatches* contact);

 private:
  /// bases: of the parts of the element.
  const ElementWeights& of(const BasisContext& context, GridIndex element,
                           const std::vector<PartBasis>& bases, const IntegralDomain& domain,
                           const Material& material);

  std::map<std::tuple<int, int, double>, OfTip> tips_;  ///< crack, end, radius
  ContentCache<ElementWeights> weights_{cycles_of_a_step};
};

}  // namespace cdca
