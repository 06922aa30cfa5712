// SPDX-License-Identifier: BSD-3-Clause
/// What loads do before bodies creep.
#pragma once

#include "core/simulation/contact_solves.hpp"
#include "core/simulation/equilibrium.hpp"

namespace cdca {

/// The loads and supports change while faces may open and close, but do not slip: from then on
/// loads are at rest, and bodies creep. gaps: of the faces before. Where faces still open and close
/// after 20 solves, they are left as they are then. Leaves the state, and patches that stick;
/// throws SolveError. Collective.
Equilibrium::BeforeCreep load_with_stuck_faces(Model& model, ContactSolves& solves,
                                               const Forces& given,
                                               const std::vector<ContactGap>& gaps);

}  // namespace cdca
