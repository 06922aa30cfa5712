// SPDX-License-Identifier: BSD-3-Clause
/// The coarsest scale, gathered and factored on every rank.
#pragma once

#include "core/base/effect.hpp"
#include "core/cells/cell_stiffness.hpp"
#include "core/hierarchy/coarsest_factor.hpp"

#include <memory>
#include <span>

namespace cdca {

class CoarsestSolve {
 public:
  /// cells must have rows for all of its cells. factor: from the last time, brought up to date;
  /// borrowed. Collective.
  CoarsestSolve(const CellStiffness& cells, CoarsestFactor& factor);
  /// The cells' springs have turned; all else is as it was. The next solve makes the factor anew.
  void turn_springs() { turned_ = true; }
  /// moves = K^-1 forces on own cells; 0 on held unknowns. Collective.
  void solve(std::span<const double> forces, std::span<double> moves) const;
  /// How far forces on each of some measures move all of them; the effects of all ranks on them
  /// count. On the first rank; empty on the others. Collective.
  Eigen::MatrixXd compliance(std::size_t measures, const std::vector<Effect>& effects) const;

 private:
  void factor_turned() const;

  const CellStiffness& cells_;
  std::vector<double> number_;  ///< of unknowns over all ranks; -1: held
  std::size_t first_ = 0;       ///< of own unknowns among those of all ranks
  std::size_t total_ = 0;
  CoarsestFactor& factor_;
  mutable bool turned_ = false;       ///< springs, since the factor was made
  std::size_t held_ = 0;              ///< own entries that stand for held unknowns come first,
  std::vector<std::size_t> entries_;  ///< then these values of the rows
};

}  // namespace cdca
