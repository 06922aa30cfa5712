// SPDX-License-Identifier: BSD-3-Clause
#include "core/solver/conjugate_gradients.hpp"

#include <algorithm>

namespace cdca {

namespace {

class Krylov final : public EquilibriumSolver {
 public:
  explicit Krylov(const SolverOptions& options) : options_(options) {}

  SolverReport solve(const CellSystem& system, std::span<const double> forces, std::span<double> u,
                     double scale, const Accuracy& accuracy) const override {
    // one sweep forward and one backward over own cells, those of other ranks held
    const auto precondition = [&system](const std::vector<double>& force,
                                        std::vector<double>& scratch, std::vector<double>& move) {
      scratch = force;
      std::fill(move.begin(), move.end(), 0.0);
      system.sweep(SweepDirection::forward, 1.0, scratch, move);
      system.sweep(SweepDirection::backward, 1.0, scratch, move);
    };
    return conjugate_gradients(system, precondition, forces, u, scale, options_, accuracy);
  }

 private:
  SolverOptions options_;
};

}  // namespace

std::unique_ptr<EquilibriumSolver> make_krylov(const SolverOptions& options) {
  return std::make_unique<Krylov>(options);
}

}  // namespace cdca
