// SPDX-License-Identifier: BSD-3-Clause
#include "core/solver/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

SolverReport conjugate_gradients(const CellSystem& system, const Preconditioner& precondition,
                                 std::span<const double> forces, std::span<double> u, double scale,
                                 const SolverOptions& options) {
  using Vector = std::vector<double>;
  const auto own = std::size_t(system.owned()), all = std::size_t(system.count());
  Vector residual(all, 0.0), move(all, 0.0), direction(all, 0.0), product(all, 0.0);
  SolverReport report;
  const auto set_residual = [&] {
    system.apply(u, residual);
    for (std::size_t k = 0; k < own; ++k) residual[k] = forces[k] - residual[k];
    system.clear_held(residual);
    report.residual = std::sqrt(system.dot(residual, residual)) / scale;
  };
  const int limit = options.max_iterations > 0 ? options.max_iterations : 200000;
  set_residual();
  // rounding makes the recurrence drift from the true residual: start again from the latter
  for (int restart = 0; restart < 5 && report.residual > options.tolerance; ++restart) {
    double energy = 0.0;
    std::fill(direction.begin(), direction.end(), 0.0);
    while (report.residual > options.tolerance && report.iterations < limit) {
      precondition(residual, product, move);
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
  report.converged = report.residual <= options.tolerance;
  return report;
}

}  // namespace cdca
