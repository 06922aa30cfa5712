// SPDX-License-Identifier: BSD-3-Clause
/// Faces turn from state to state by what each solve shows, until their tractions are in balance.
#pragma once

#include "core/simulation/contact_solves.hpp"
#include "core/simulation/linear_solve.hpp"

namespace cdca {

/// Newton's method for the laws of the faces, with a line search.
class FaceTurns {
 public:
  struct Rule {
    double enough = 0.0;  ///< balanced: to this part of the largest traction
    int most = 0;         ///< turns
    /// Drag on all bodies from where they are at first, as a part of the cells' own stiffness.
    /// Without it loose bodies alone feel weak springs, which go along with them and get weaker.
    double drag = 0.0;
    /// How far limits of friction go at first, in steps from those before to those that pressures
    /// ask for.
    double ahead = 1.0;
  };
  /// Begins at the model's state. Collective, as the others.
  FaceTurns(Model& model, ContactSolves& solves, Forces& given, const Rule& rule);

  /// Tractions unbalanced by this part of the largest: few faces are left to turn.
  static constexpr double nearly = 1e-2;

  enum class End { balanced, jammed, too_many };
  /// Goes on until faces are in balance, or jam: their moves become short again and again, or there
  /// have been many.
  End turn();
  /// When faces have jammed: after so many short moves, or turns from the start; 0: they are left
  /// to FaceBalance.
  struct Patience {
    int short_moves = 0, turns = 0;
  };
  /// Springs are those of the faces as they are; after others have moved the model.
  void begin_again();
  /// Others have moved the model to where tractions are unbalanced by this part of the largest.
  void take(double unbalanced);

  int count() const { return count_; }
  void add_to_count(int steps) { count_ += steps; }
  double unbalanced() const { return unbalanced_; }
  /// The same with the limits of friction that the pressures ask for: in drag they stay as they
  /// were at first.
  double limits_off() const { return limits_off_; }
  /// Do those agree as well as solves and rounding let tractions be told?
  bool limits_agree() const { return limits_off_ <= balanced_to_; }
  /// Taken by springs of bodies in the last turn, as a part of the loads.
  double pulled() const { return pulled_; }

 private:
  bool drags() const { return rule_.drag > 0.0; }
  bool once();
  std::vector<double> from_anchor() const;

  Model& model_;
  ContactSolves& solves_;
  Forces& given_;
  Rule rule_;
  Patience patience_;
  double part_ = 1.0;  ///< of the solver's tolerance
  double weak_;        ///< springs of bodies
  double unbalanced_ = 1.0, limits_off_ = 1.0, pulled_ = 0.0;
  double balanced_to_ = -1.0;  ///< of the last turn; below 0: its solve was not exact
  bool settled_ = false;
  int count_ = 0;      ///< turns so far
  int cut_short_ = 0;  ///< short moves so far
};

}  // namespace cdca
