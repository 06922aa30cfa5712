// SPDX-License-Identifier: BSD-3-Clause
/// Cells with springs that have turned since their stiffness was built.
#pragma once

#include "core/cells/cell_stiffness.hpp"
#include "core/mechanics/contact_spots.hpp"

#include <vector>

namespace cdca {

/// The stiffness as it was built, and on top of it what has changed in the springs of faces and in
/// the weak springs of loose bodies. Where little changes this spares new rows and factors: those
/// that there are still move the cells nearly as they should. Borrows both.
class TurnedCells final : public CellSystem {
 public:
  TurnedCells(const CellStiffness& built, const ContactSpots& spots)
      : built_(built), spots_(spots) {}

  /// weak: of weak springs, as a part of what they were built with.
  void turn(std::vector<ContactSpots::TurnedSpring> springs, double weak);

  LocalId owned() const override { return built_.owned(); }
  LocalId count() const override { return built_.count(); }
  Communicator& communicator() const override { return built_.communicator(); }
  const Halo& halo() const { return built_.halo(); }
  void apply(std::span<const double> x, std::span<double> forces) const override;
  void set_residual(std::span<const double> forces, std::span<const double> x,
                    std::span<double> residual) const override;
  /// Of the stiffness as it was built.
  void sweep(SweepDirection direction, double omega, std::span<double> forces,
             std::span<double> displacements) const override;
  void sweep_all(double omega, std::span<double> forces,
                 std::span<double> displacements) const override;
  void return_forces(std::span<double> forces) const override { built_.return_forces(forces); }
  void clear_held(std::span<double> values) const override { built_.clear_held(values); }
  /// As CellStiffness::add_spring_forces().
  void add_spring_forces(std::span<const double> displacements, std::span<double> forces) const {
    built_.add_spring_forces(displacements, forces, weak_);
  }

 private:
  bool as_built() const { return springs_.empty() && weak_ == 1.0; }
  /// Adds `sign` times the change on own cells.
  void add_change(double sign, std::span<const double> x, std::span<double> forces) const;

  const CellStiffness& built_;
  const ContactSpots& spots_;
  std::vector<ContactSpots::TurnedSpring> springs_;
  double weak_ = 1.0;
  mutable std::vector<double> with_ghosts_;
};

}  // namespace cdca
