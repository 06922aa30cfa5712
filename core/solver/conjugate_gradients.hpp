// SPDX-License-Identifier: BSD-3-Clause
/// Conjugate gradients round any symmetric way of moving cells.
#pragma once

#include "core/solver/equilibrium_solver.hpp"

#include <functional>
#include <vector>

namespace cdca {

/// move = M^-1 force, M symmetric and positive definite. `force` keeps its values on own cells;
/// `scratch` may be used, and holds what the caller does not need any more.
using Preconditioner = std::function<void(const std::vector<double>& force,
                                          std::vector<double>& scratch, std::vector<double>& move)>;

SolverReport conjugate_gradients(const CellSystem& system, const Preconditioner& precondition,
                                 std::span<const double> forces, std::span<double> u, double scale,
                                 const SolverOptions& options, const Accuracy& accuracy = {});

}  // namespace cdca
