// SPDX-License-Identifier: BSD-3-Clause
/// The multilevel automaton: conjugate gradients with a V-cycle of cellular automata.
#pragma once

#include "core/solver/equilibrium_solver.hpp"
#include "core/solver/scales.hpp"

#include <vector>

namespace cdca {

/// One V-cycle: plain cells, windows, the next scale, windows and plain cells in reverse. It is
/// symmetric, and keeps the vectors of the coarser scales from one call to the next.
class VCycle {
 public:
  explicit VCycle(const Scales& scales);
  /// moves = M^-1 forces on the finest scale; scratch: of the size of the vectors there.
  /// Collective.
  void operator()(std::span<const double> forces, std::span<double> scratch,
                  std::span<double> moves);

 private:
  struct Vectors {
    std::vector<double> forces, residual, moves;
  };
  void cycle(std::size_t index, std::span<const double> forces, std::span<double> residual,
             std::span<double> moves);

  const Scales& scales_;
  std::vector<Vectors> vectors_;  ///< of every scale but the finest
};

/// scales: borrowed; looked at anew in every solve, so that they may change in between.
std::unique_ptr<EquilibriumSolver> make_multilevel(const SolverOptions& options,
                                                   const Scales& scales);

}  // namespace cdca
