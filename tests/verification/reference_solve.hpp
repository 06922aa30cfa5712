// SPDX-License-Identifier: BSD-3-Clause
/// Solves a reference case with the program's own cells.
#pragma once

#include "core/mechanics/interaction_integral.hpp"
#include "tests/verification/reference_cases.hpp"
#include "tests/verification/reference_plane.hpp"

#include <memory>

namespace cdca::testing {

/// The grid of a case: elements at most a/20 wide, a the half length (of an edge crack the length)
/// of the shortest crack, and at most an eighth of the way from a tip to a bend, another crack or
/// the rim; near-tip functions on all nodes within 4.2 such lengths of a tip. Rectangle: the
/// plate, or two longest half lengths round the cracks of an infinite plane.
struct ReferenceGrid {
  Vec2 lower{0, 0};
  Vec2 upper{0, 0};
  int nx = 0;
  int ny = 0;
  double tip_radius = 0.0;
  /// k_N h / E of touching faces; k_T is a hundredth of k_N.
  double contact_stiffness = 1000.0;

  /// Rough: time grows with elements times iterations, and the latter with elements across.
  double cost(const ReferenceGeometry& g) const;
};
ReferenceGrid grid_of(const ReferenceGeometry& g);

/// Material: plane strain, E = 1000, nu = 0.3 (0.25 for the held plate under shear); K does not
/// depend on it when only tractions act.
CaseSpec spec_of(const ReferenceGeometry& g, const ReferenceLoad& load, const ReferenceGrid& grid);

struct SolvedReference {
  std::unique_ptr<CaseSpec> spec;
  std::unique_ptr<PlaneRim> rim;  ///< of an infinite plane
  std::unique_ptr<Model> model;
  std::vector<StressIntensity> tips;
  int solves = 1;  ///< until the rim of an infinite plane changed nothing any more
};
SolvedReference solve_reference(const ReferenceGeometry& g, const ReferenceLoad& load,
                                const ReferenceGrid& grid);

std::vector<StressIntensity> tips_of(const Model& model);

/// The mean stress of a rectangle of one element's size with its middle at x, off all cracks. The
/// stress itself jumps from element to element and is good to first order only; this is good to
/// second order wherever the place lies in the grid.
Voigt mean_stress(const Model& model, const Vec2& x);

/// The K of the tip at a place. Throws when there is none within a thousandth of an element.
const StressIntensity& tip_at(const SolvedReference& solved, const Vec2& at);

}  // namespace cdca::testing
