// SPDX-License-Identifier: BSD-3-Clause
/// What a solver may know: cells, forces and moves. No crack, no material, no rank.
#pragma once

#include "core/base/communicator.hpp"
#include "core/base/types.hpp"

#include <span>

namespace cdca {

enum class SweepDirection { forward, backward };

/// The cells of a body and what they do to each other. Vectors hold the unknowns of this rank's own
/// cells first, then those of ghosts; forces and displacements have the same layout.
class CellSystem {
 public:
  virtual ~CellSystem() = default;

  /// Unknowns of own cells.
  virtual LocalId owned() const = 0;
  /// Unknowns of own cells and ghosts.
  virtual LocalId count() const = 0;
  virtual Communicator& communicator() const = 0;

  /// forces = K displacements, on own cells; entries of held unknowns included. Displacements of
  /// ghosts are not read: their owners send the forces instead. Collective.
  virtual void apply(std::span<const double> displacements, std::span<double> forces) const = 0;

  /// residual = forces - K displacements on own cells, 0 for held unknowns. Collective.
  virtual void set_residual(std::span<const double> forces, std::span<const double> displacements,
                            std::span<double> residual) const = 0;

  /// One sweep of the rule (2.4.3, 1-3) over this rank's cells, one after the other: the
  /// out-of-balance force f_i moves cell i by omega K_i^-1 f_i, neighbours held, and the move
  /// changes the forces of the cell and of its neighbours by -K_ki du_i, ghosts included.
  virtual void sweep(SweepDirection direction, double omega, std::span<double> forces,
                     std::span<double> displacements) const = 0;

  /// One sweep of the rule over the cells of all ranks. Cells that share an element with a cell of
  /// another rank are moved while that rank's stand still, so that the rule is one cell after the
  /// other on any number of ranks. Forces on ghosts are handed over on the way. Collective.
  virtual void sweep_all(double omega, std::span<double> forces,
                         std::span<double> displacements) const = 0;

  /// Hands the force increments on ghosts to their owners. Collective.
  virtual void return_forces(std::span<double> forces) const = 0;

  /// Sets the entries of held unknowns to zero.
  virtual void clear_held(std::span<double> values) const = 0;

  /// Inner product over all ranks. Collective.
  double dot(std::span<const double> a, std::span<const double> b) const {
    // Eigen adds in several lanes at once, which plain loops may not
    using Values = Eigen::Map<const Eigen::VectorXd>;
    const auto n = Eigen::Index(owned());
    return communicator().sum(Values(a.data(), n).dot(Values(b.data(), n)));
  }
};

}  // namespace cdca
