// SPDX-License-Identifier: BSD-3-Clause
/// Brings cells into equilibrium. A solver knows cells, forces and moves only.
#pragma once

#include "core/base/cell_system.hpp"

#include <algorithm>
#include <memory>
#include <span>

namespace cdca {

struct SolverOptions {
  double tolerance = 1e-8;       ///< of the residual, relative to `scale`
  double over_relaxation = 1.0;  ///< of the rule; relaxation only
  int max_iterations = 0;        ///< 0: chosen from the number of unknowns
};

/// When one solve is exact enough.
struct Accuracy {
  double part = 1.0;  ///< of SolverOptions::tolerance
  /// Or where the residual has fallen to this part of what it was at first. A result that need not
  /// be more exact is not checked once more.
  double of_start = 0.0;
  /// The residual, relative to `scale`, at which a solve ends that starts with `first`.
  double enough(double tolerance, double first) const {
    return std::max(part * tolerance, of_start * first);
  }
};

struct SolverReport {
  /// The residual is within what was asked for, or as small as rounding of u lets it be.
  bool converged = false;
  bool rounded = false;   ///< the latter: larger than what was asked for
  int iterations = 0;     ///< sweeps of the rule, or steps of CG
  double residual = 0.0;  ///< relative to `scale`
  double scale = 0.0;     ///< N/m; set by who knows all forces
};

class EquilibriumSolver {
 public:
  virtual ~EquilibriumSolver() = default;
  /// Solves K u = f for the unknowns that are not held; u of the held ones must be 0 and stays so.
  /// u: start value in, result out (own cells). scale: the force that residuals are compared with,
  /// N/m.
  virtual SolverReport solve(const CellSystem& system, std::span<const double> forces,
                             std::span<double> u, double scale,
                             const Accuracy& accuracy = {}) const = 0;
};

/// The rule alone (2.4.3, 1-4): sweeps until nothing moves.
std::unique_ptr<EquilibriumSolver> make_relaxation(const SolverOptions& options);

/// Conjugate gradients with one symmetric sweep of the rule as preconditioner. Across ranks the
/// sweep holds the cells of the others, which keeps it symmetric on any number of them.
std::unique_ptr<EquilibriumSolver> make_krylov(const SolverOptions& options);

}  // namespace cdca
