// SPDX-License-Identifier: BSD-3-Clause
/// The linear solves with which faces settle.
#pragma once

#include "core/simulation/linear_solve.hpp"

namespace cdca {

/// Solves of a model under the loads of one load factor. given.faces is set here.
class ContactSolves {
 public:
  ContactSolves(Model& model, const EquilibriumSolver& solver, double load_factor, Forces& given)
      : model_(model), solver_(solver), load_factor_(load_factor), given_(given) {}

  /// With what the patches answer now. Collective, as the others.
  void once(const Accuracy& accuracy);
  /// Friction follows the pressure, and the pressure depends on friction: in turns, until they
  /// agree to this part of the largest traction. part: of the solver's tolerance.
  void turn_limits(double agreed, double part);
  /// Patches answer so from now on; their springs count from the next renew_stiffness() on.
  void answer(const std::vector<ContactAnswer>& answers);

  std::vector<ContactGap> gaps() const;
  /// Forces that weak springs have added on this way, as a part of those of the loads: bodies may
  /// not have gone far enough yet.
  double held_back(const std::vector<double>& move) const;
  /// How well tractions can be told at all, as a part of the largest: gaps are differences of
  /// displacements, which are large where loose bodies have gone far, and what is less than the
  /// residual of a solve does not matter. Not more than `worst` for the former. Collective.
  double rounding(double largest, double worst = worst_balance) const;
  /// What rounding may take from a balance at the worst, as a part of the largest traction.
  static constexpr double worst_balance = 1e-5;
  /// Weak springs where faces near them hold loose bodies, as a part of the cells' own stiffness.
  static constexpr double loosest = 1e-9;
  int count() const { return count_; }
  /// Iterations of the slowest so far, and how exact the last one was.
  const SolverReport& slowest() const { return slowest_; }
  /// given.faces for what the patches answer now.
  void set_forces_of_faces();

 private:
  /// Forces of the loads, and those with which prescribed displacements act on the cells beside
  /// them, N per metre of thickness; where there are none, of the faces.
  double loads() const;

  Model& model_;
  const EquilibriumSolver& solver_;
  double load_factor_;
  Forces& given_;
  SolverReport slowest_;
  int count_ = 0;
};

}  // namespace cdca
