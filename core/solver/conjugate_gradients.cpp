// SPDX-License-Identifier: BSD-3-Clause
#include "core/solver/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace cdca {

namespace {

using Values = Eigen::Map<Eigen::VectorXd>;
using ConstValues = Eigen::Map<const Eigen::VectorXd>;

/// u += alpha direction, residual -= alpha product; returns the new |residual|^2 of this rank. In
/// blocks that stay in the cache, so that the residual is read once.
double advance(double alpha, const ConstValues& direction, const ConstValues& product, Values& u,
               Values& residual) {
  constexpr Eigen::Index block = 1024;
  double sum = 0.0;
  for (Eigen::Index first = 0; first < u.size(); first += block) {
    const Eigen::Index count = std::min(block, u.size() - first);
    u.segment(first, count) += alpha * direction.segment(first, count);
    auto part = residual.segment(first, count);
    part -= alpha * product.segment(first, count);
    sum += part.squaredNorm();
  }
  return sum;
}

/// How much the forces change when every value of u moves by half a unit in its last place: what a
/// residual cannot fall below.
double rounding_of(const CellSystem& system, std::span<const double> u, std::vector<double>& moves,
                   std::vector<double>& forces) {
  constexpr double half_unit = 0.5 * std::numeric_limits<double>::epsilon();
  std::minstd_rand engine;
  for (std::size_t k = 0; k < std::size_t(system.owned()); ++k) {
    moves[k] = (engine() & 1U ? half_unit : -half_unit) * u[k];
  }
  system.apply(moves, forces);
  system.clear_held(forces);
  return std::sqrt(system.dot(forces, forces));
}

}  // namespace

SolverReport conjugate_gradients(const CellSystem& system, const Preconditioner& precondition,
                                 std::span<const double> forces, std::span<double> u, double scale,
                                 const SolverOptions& options, const Accuracy& accuracy) {
  using Vector = std::vector<double>;
  const auto all = std::size_t(system.count());
  const auto own = Eigen::Index(system.owned());
  Vector residual(all, 0.0), move(all, 0.0), direction(all, 0.0), product(all, 0.0);
  Values own_u(u.data(), own), own_residual(residual.data(), own);
  Values own_direction(direction.data(), own);
  const ConstValues own_move(move.data(), own), own_product(product.data(), own);
  SolverReport report;
  const auto set_residual = [&] {
    system.set_residual(forces, u, residual);
    report.residual = std::sqrt(system.dot(residual, residual)) / scale;
  };
  constexpr double coarsest_rounding = 1e-6;  // beyond that no result is of any use
  const int limit = options.max_iterations > 0 ? options.max_iterations : 200000;
  set_residual();
  const double enough = accuracy.enough(options.tolerance, report.residual);
  report.converged = report.residual <= enough;
  double before = std::numeric_limits<double>::infinity();
  // rounding makes the recurrence drift from the true residual: start again from the latter
  for (int restart = 0; restart < 5 && !report.converged; ++restart) {
    double energy = 0.0;
    while (report.residual > enough && report.iterations < limit) {
      precondition(residual, product, move);
      const double next = system.dot(residual, move);
      if (energy > 0.0) {
        own_direction = own_move + (next / energy) * own_direction;
      } else {
        own_direction = own_move;
      }
      energy = next;
      system.apply(direction, product);
      system.clear_held(product);
      const double curvature = system.dot(direction, product);
      ++report.iterations;
      if (!(curvature > 0.0)) break;
      const double sum = advance(energy / curvature, ConstValues(direction.data(), own),
                                 own_product, own_u, own_residual);
      report.residual = std::sqrt(system.communicator().sum(sum)) / scale;
    }
    const bool ended = report.residual <= enough;
    report.converged = ended;
    if (report.converged && accuracy.of_start > 0.0) break;
    set_residual();
    report.converged = report.residual <= enough;
    if (report.converged || report.iterations >= limit || !std::isfinite(report.residual)) break;
    // a force is a sum of some tens of products, each of them rounded too
    double least = 8 * rounding_of(system, u, direction, product) / scale;
    // the recurrence has ended twice, and the true residual is where it was: that is rounding, too
    if (ended && report.residual > 0.5 * before) least = report.residual;
    before = ended ? report.residual : std::numeric_limits<double>::infinity();
    report.converged = report.rounded = report.residual <= std::min(least, coarsest_rounding);
  }
  return report;
}

}  // namespace cdca
