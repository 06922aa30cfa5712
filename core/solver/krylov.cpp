// SPDX-License-Identifier: BSD-3-Clause
#include "core/solver/equilibrium_solver.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cdca {

namespace {

using Vector = std::vector<double>;

/// move = M^-1 force: one sweep forward and one backward over own cells, those of other ranks held.
void precondition(const CellSystem& system, const Vector& force, Vector& scratch, Vector& move) {
  scratch = force;
  std::fill(move.begin(), move.end(), 0.0);
  system.sweep(SweepDirection::forward, 1.0, scratch, move);
  system.sweep(SweepDirection::backward, 1.0, scratch, move);
}

class Krylov final : public EquilibriumSolver {
 public:
  explicit Krylov(const SolverOptions& options) : options_(options) {}

  SolverReport solve(const CellSystem& system, std::span<const double> forces, std::span<double> u,
                     double scale) const override {
    const auto own = std::size_t(system.owned()), all = std::size_t(system.count());
    Vector residual(all, 0.0), move(all, 0.0), direction(all, 0.0), product(all, 0.0), scratch(all);
    SolverReport report;
    const auto set_residual = [&] {
      system.apply(u, residual);
      for (std::size_t k = 0; k < own; ++k) residual[k] = forces[k] - residual[k];
      system.clear_held(residual);
      report.residual = std::sqrt(system.dot(residual, residual)) / scale;
    };
    const int limit = options_.max_iterations > 0 ? options_.max_iterations : 200000;
    set_residual();
    // rounding makes the recurrence drift from the true residual: start again from the latter
    for (int restart = 0; restart < 5 && report.residual > options_.tolerance; ++restart) {
      double energy = 0.0;
      std::fill(direction.begin(), direction.end(), 0.0);
      while (report.residual > options_.tolerance && report.iterations < limit) {
        precondition(system, residual, scratch, move);
        const double next = system.dot(residual, move);
        const double beta = energy > 0.0 ? next / energy : 0.0;
        energy = next;
        for (std::size_t k = 0; k < own; ++k) direction[k] = move[k] + beta * direction[k];
        system.apply(direction, product);
        system.clear_held(product);
        const double curvature = system.dot(direction, product);
        ++report.iterations;
        if (!(curvature > 0.0)) break;
        const double alpha = energy / curvature;
        for (std::size_t k = 0; k < own; ++k) {
          u[k] += alpha * direction[k];
          residual[k] -= alpha * product[k];
        }
        report.residual = std::sqrt(system.dot(residual, residual)) / scale;
      }
      set_residual();
      if (report.iterations >= limit || !std::isfinite(report.residual)) break;
    }
    report.converged = report.residual <= options_.tolerance;
    return report;
  }

 private:
  SolverOptions options_;
};

}  // namespace

std::unique_ptr<EquilibriumSolver> make_krylov(const SolverOptions& options) {
  return std::make_unique<Krylov>(options);
}

}  // namespace cdca
