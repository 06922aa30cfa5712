// SPDX-License-Identifier: BSD-3-Clause
/// The coarsest scale, gathered and factored on every rank.
#pragma once

#include "core/cells/cell_stiffness.hpp"
#include "core/hierarchy/elimination_order.hpp"

#include <memory>
#include <span>

namespace cdca {

/// The order in which unknowns are eliminated. It outlasts small changes of the cracks: a factor
/// that has become too large for it asks for a new one.
struct EliminationOrder {
  Eigen::VectorXi place;         ///< by unknown
  Eigen::Index entries = 0;      ///< of the factor that it was made for; 0: not known yet
  Eigen::Index entries_now = 0;  ///< of the last factor
};

class CoarsestSolve {
 public:
  /// cells must have rows for all of its cells. order: from the last time, brought up to date.
  /// Collective.
  CoarsestSolve(const CellStiffness& cells, EliminationOrder& order);
  /// moves = K^-1 forces on own cells; 0 on held unknowns. Collective.
  void solve(std::span<const double> forces, std::span<double> moves) const;

 private:
  const CellStiffness& cells_;
  std::size_t first_ = 0;  ///< of own unknowns among those of all ranks
  std::size_t total_ = 0;
  Eigen::VectorXi place_;  ///< of every unknown in the factor
  OrderedFactor factor_;
};

}  // namespace cdca
