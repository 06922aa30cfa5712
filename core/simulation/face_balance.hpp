// SPDX-License-Identifier: BSD-3-Clause
/// All faces brought into balance at once.
#pragma once

#include "core/mechanics/face_barrier.hpp"
#include "core/mechanics/held_faces.hpp"
#include "core/simulation/contact_solves.hpp"

#include <algorithm>
#include <vector>

namespace cdca {

/// Goes to an equilibrium: with the body condensed to its faces by turns of these, then with the
/// steps of FaceBarrier, and then with those and the whole body. Without drag, given.anchor is set
/// on the way.
class FaceBalance {
 public:
  struct Rule {
    double enough = 0.0;  ///< unbalanced tractions that are left, as a part of the largest
    double near = 0.0;    ///< the same: where steps are stuck this near, they do not begin anew
    /// As of FaceTurns: with drag, given.anchor stays what it is.
    double drag = 0.0;
    bool limits_stay = false;  ///< of friction; otherwise they follow the pressures
    bool turns_alone = false;  ///< of faces on the condensed body, and no other steps
  };
  FaceBalance(Model& model, ContactSolves& solves, Forces& given, const Rule& rule);

  struct Found {
    bool found = false;
    double unbalanced = 1.0;  ///< tractions, as a part of the largest
    /// Each with springs of its own; all turns of faces on the condensed body from one place are
    /// one.
    int steps = 0;
  };
  /// Leaves springs, states and limits of that balance, or of where faces were nearest to it.
  /// Collective.
  Found find();

 private:
  /// As far as it goes with the body condensed to its faces, from where faces are balanced or not.
  void go_condensed();
  /// Turns of faces on it from such gaps; whether they lead to a balance of the whole body.
  bool turn_condensed(FacesOfBody& condensed, std::vector<ContactGap> closed_gaps,
                      std::vector<ContactGap> from);
  /// One step with the whole body.
  void step_whole();
  /// Moves the whole body to where faces exert such tractions at such gaps, as far as both agree
  /// with it. Returns what they exert then.
  std::vector<FaceTraction> move_to(const std::vector<ContactGap>& gaps,
                                    const std::vector<FaceTraction>& tractions);
  /// The same once more from there, without what rounding has left of the way.
  std::vector<FaceTraction> move_closer_to(const std::vector<ContactGap>& gaps,
                                           const std::vector<FaceTraction>& tractions);
  /// Whether the state at hand is the one that is looked for. tractions: of its faces.
  void judge(const std::vector<FaceTraction>& tractions);
  double off() const { return std::max(now_.unbalanced, left_); }
  /// After a step that has not found it. least: unbalanced so far.
  bool is_of_use_to_go_on(double least);
  double agreement() const;
  bool drags() const { return rule_.drag > 0.0; }

  Model& model_;
  ContactSolves& solves_;
  Forces& given_;
  Rule rule_;
  double weak_;  ///< springs of bodies
  FrictionLimits limits_;
  std::vector<double> compliances_;  ///< of the body at every patch, m/Pa
  double softness_;                  ///< of the body over a patch, m/Pa
  HeldFaces held_;
  FaceBarrier faces_;
  Found now_;
  double noise_ = 0.0;  ///< by which tractions of two solves of the same forces have differed, Pa
  double left_ = 1.0;   ///< of the forces that are out of balance: steps do not go all the way
  double least_ = 1.0;
  int restarts_ = 0;
  bool gave_up_ = false;
  bool condensed_ = false;       ///< steps went over the condensed body
  int rounds_ = 0;               ///< with the condensed body
  bool anchored_anew_ = true;    ///< weak springs hold loose bodies where they have come to now
  std::vector<double> nearest_;  ///< state
};

}  // namespace cdca
