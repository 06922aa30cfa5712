// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/turned_cells.hpp"

#include <utility>

namespace cdca {

void TurnedCells::turn(std::vector<ContactSpots::TurnedSpring> springs, double weak) {
  springs_ = std::move(springs);
  weak_ = weak;
}

void TurnedCells::apply(std::span<const double> x, std::span<double> forces) const {
  built_.apply(x, forces);
  add_change(1.0, x, forces);
}

void TurnedCells::set_residual(std::span<const double> forces, std::span<const double> x,
                               std::span<double> residual) const {
  built_.set_residual(forces, x, residual);
  add_change(-1.0, x, residual);
  built_.clear_held(residual);
}

void TurnedCells::add_change(double sign, std::span<const double> x,
                             std::span<double> forces) const {
  const bool none = communicator().sum(std::int64_t(as_built() ? 0 : 1)) == 0;
  if (none) return;
  with_ghosts_.assign(x.begin(), x.end());
  halo().copy_state(with_ghosts_);
  spots_.add_turned(springs_, with_ghosts_, owned(), sign, forces);
  if (weak_ != 1.0) built_.add_spring_forces(x, forces, sign * (weak_ - 1.0));
}

void TurnedCells::sweep(SweepDirection direction, double omega, std::span<double> forces,
                        std::span<double> displacements) const {
  built_.sweep(direction, omega, forces, displacements);
}

void TurnedCells::sweep_all(double omega, std::span<double> forces,
                            std::span<double> displacements) const {
  built_.sweep_all(omega, forces, displacements);
}

}  // namespace cdca
