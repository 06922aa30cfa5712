// SPDX-License-Identifier: BSD-3-Clause
/// The same rule on every scale: what the multilevel solver knows of coarse cells.
#pragma once

#include "core/base/cell_system.hpp"

#include <cstddef>
#include <span>

namespace cdca {

/// The cells of one scale. Vectors have the layout of CellSystem; forces of ghosts are 0 on entry
/// and on return.
class Scale {
 public:
  virtual ~Scale() = default;
  virtual const CellSystem& cells() const = 0;

  /// The rule for all cells away from cracks at once, damped: adds moves, leaves forces as they
  /// are. Collective.
  virtual void move_plain_cells(std::span<const double> forces, std::span<double> moves) const = 0;
  /// As move_plain_cells() for cells that have not moved yet: the moves on entry do not count.
  /// Collective.
  virtual void start_plain_cells(std::span<const double> forces, std::span<double> moves) const = 0;
  /// The rule for cells near cracks, window by window; brings the forces up to date. Collective.
  virtual void move_windows(SweepDirection direction, std::span<double> forces,
                            std::span<double> moves) const = 0;
  /// Hands the forces over to the cells of the next scale. Collective.
  virtual void forces_to_coarser(std::span<const double> forces,
                                 std::span<double> coarser) const = 0;
  /// Adds the moves of the next scale. Collective.
  virtual void add_moves_of_coarser(std::span<double> coarser, std::span<double> moves) const = 0;
  /// On the coarsest scale: moves = K^-1 forces. Collective.
  virtual void solve(std::span<const double> forces, std::span<double> moves) const = 0;
};

/// All scales of a body, the finest first.
class Scales {
 public:
  virtual ~Scales() = default;
  virtual std::size_t count() const = 0;
  virtual const Scale& scale(std::size_t index) const = 0;
};

}  // namespace cdca
