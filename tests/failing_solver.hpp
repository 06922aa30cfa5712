// SPDX-License-Identifier: BSD-3-Clause
/// A solver that fails when it is told to.
#pragma once

#include "core/solver/equilibrium_solver.hpp"

namespace cdca::testing {

/// Solves as another solver does, but for some in a row that come nowhere near.
class Fails final : public EquilibriumSolver {
 public:
  /// at: the first that does, from 1; count: how many.
  Fails(const EquilibriumSolver& other, int at, int count)
      : other_(other), first_(at), last_(at + count - 1) {}
  SolverReport solve(const CellSystem& system, std::span<const double> forces, std::span<double> u,
                     double scale, const Accuracy& accuracy) const override {
    SolverReport report = other_.solve(system, forces, u, scale, accuracy);
    ++done_;
    if (done_ < first_ || done_ > last_) return report;
    for (double& value : u) value *= 1e6;
    report.converged = false;
    report.residual = 1.0;
    return report;
  }

 private:
  const EquilibriumSolver& other_;
  int first_, last_;
  mutable int done_ = 0;
};

}  // namespace cdca::testing
