// SPDX-License-Identifier: BSD-3-Clause
/// Steps 5-7 of 2.4.3: faces open, stick and slide until their tractions are in balance.
#pragma once

#include "core/simulation/equilibrium.hpp"
#include "core/simulation/linear_solve.hpp"

namespace cdca {

/// Solves until the tractions that faces answer with are those that the last solve counted with.
/// motion: balanced or creeping. given.faces is set here. Sets the contact's part of `result`;
/// returns the report of the slowest solve. Throws ContactError when this does not come to an end.
/// Collective.
SolverReport settle_contact(Model& model, const EquilibriumSolver& solver, double load_factor,
                            FaceMotion motion, Forces& given, Equilibrium& result);

}  // namespace cdca
