// SPDX-License-Identifier: BSD-3-Clause
#include "core/solver/equilibrium_solver.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cdca {

namespace {

class Relaxation final : public EquilibriumSolver {
 public:
  explicit Relaxation(const SolverOptions& options) : options_(options) {}

  SolverReport solve(const CellSystem& system, std::span<const double> forces, std::span<double> u,
                     double scale, const Accuracy& accuracy) const override {
    std::vector<double> residual(std::size_t(system.count()), 0.0);
    system.set_residual(forces, u, residual);
    SolverReport report;
    double enough = 0.0;
    const int limit = options_.max_iterations > 0 ? options_.max_iterations : 1000000;
    for (;; ++report.iterations) {
      report.residual = std::sqrt(system.dot(residual, residual)) / scale;
      if (report.iterations == 0) enough = accuracy.enough(options_.tolerance, report.residual);
      report.converged = report.residual <= enough;
      if (report.converged || report.iterations >= limit || !std::isfinite(report.residual)) break;
      system.sweep_all(options_.over_relaxation, residual, u);
      system.clear_held(residual);
    }
    return report;
  }

 private:
  SolverOptions options_;
};

}  // namespace

std::unique_ptr<EquilibriumSolver> make_relaxation(const SolverOptions& options) {
  return std::make_unique<Relaxation>(options);
}

}  // namespace cdca
