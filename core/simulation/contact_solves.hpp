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
  /// Turns many faces at once (face_relaxation.hpp), until their tractions are balanced to this
  /// part of the largest or for as long as it is worth while, and leaves springs, states and limits
  /// near those of balance. weak: of the springs of loose bodies. Returns how far from balance they
  /// are.
  double relax_faces(double enough, double weak);

  /// Brings the stiffness up to date. Where one factor moves all cells, what has changed since it
  /// was built lies on top of it for as long as the solves are not much slower for that. weak: as
  /// in relax_faces().
  void turn_springs(double weak);

  std::vector<ContactGap> gaps() const;
  int count() const { return count_; }
  /// Iterations of the slowest so far, and how exact the last one was.
  const SolverReport& slowest() const { return slowest_; }

 private:
  void set_forces_of_faces();
  void build_stiffness(double weak);

  Model& model_;
  const EquilibriumSolver& solver_;
  double load_factor_;
  Forces& given_;
  SolverReport slowest_;
  int count_ = 0;
  int quickest_ = 0;  ///< iterations of a solve since the stiffness was built; 0: none yet
  int lost_ = 0;      ///< iterations since then, less so many a solve
};

}  // namespace cdca
