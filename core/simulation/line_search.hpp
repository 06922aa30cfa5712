// SPDX-License-Identifier: BSD-3-Clause
/// How far to go towards the next state where faces may change theirs on the way.
#pragma once

#include "core/simulation/model.hpp"

#include <vector>

namespace cdca {

/// A solve counts with springs that may be the wrong ones where it leads. As long as friction keeps
/// to the limits that it has, loads, body and faces have a potential, which is convex and has no
/// jumps in its slope. A move has to lower it; where the whole move does not, one goes to where the
/// forces on the way are in balance. So faces cannot be thrown from one state into another and back
/// for ever.
class LineSearch {
 public:
  /// From a state `from` to that of the model. external: forces of the loads, N/m. anchor: where
  /// weak springs stand; if empty they go along and do not count. Collective.
  LineSearch(const Model& model, const std::vector<double>& external,
             const std::vector<double>& from, const std::vector<double>& anchor = {});

  /// Share of the way: up to 1, or up to `most` where the forces are hardly less after the whole
  /// move, since weak springs have stopped it. Collective.
  double find(double most) const;
  const std::vector<double>& move() const { return move_; }
  /// Of all patches there.
  std::vector<ContactGap> gaps(double share) const;
  /// Sets a state there.
  void go(double share, const std::vector<double>& from, std::vector<double>& state) const;

 private:
  std::vector<ContactGap> gaps_of(const std::vector<double>& state) const;
  /// Of all forces on the move, where this share of it is done.
  double work(double share) const;
  /// What loads, body and faces store less there than at the start: the integral of the work.
  double released(double share) const;

  const Model& model_;
  std::vector<double> move_;
  double driving_ = 0.0;    ///< work of loads and body on the move, at its start
  double stiffness_ = 0.0;  ///< of the body along the move
  ContactSpots::Fields at_, moves_;
  std::vector<ContactGap> gaps_, gaps_there_;
};

}  // namespace cdca
