// SPDX-License-Identifier: BSD-3-Clause
/// The way to an equilibrium that is far away: bodies move as if in honey.
#pragma once

#include "core/simulation/contact_solves.hpp"

namespace cdca {

struct Crept {
  bool found = false;
  int turns = 0;
  int steps = 0;            ///< of all faces at once, between turns
  double unbalanced = 1.0;  ///< tractions, as a part of the largest
  /// A part has gone as far as the body is long, and is pulled no less with less drag.
  bool slides_off = false;
};

/// Where faces lose their hold, the next equilibrium may be far away, and with friction it depends
/// on the way there. Here drag resists all motion, faces slip on the way (Model::let_slip), and
/// every step is a balance with the drag, which is easier to find the firmer the drag is. Within a
/// step friction keeps to the limits that pressures set before it: then it is one minimum to find.
/// Ends where drag takes less than 1e-6 of the loads, with tractions balanced to `enough` of the
/// largest; where that is not found, or a part slides off and nothing stops it, states and
/// displacements are what they were. Collective. most: turns, about.
Crept creep_to_balance(Model& model, ContactSolves& solves, Forces& given, double enough, int most);

}  // namespace cdca
