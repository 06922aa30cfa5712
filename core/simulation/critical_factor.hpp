// SPDX-License-Identifier: BSD-3-Clause
/// The search for the load factor at which the next tip grows, where faces touch.
#pragma once

#include <optional>

namespace cdca {

/// Load factors to try, one after the other, until the greatest index of all tips is 1. The index
/// is a broken line over the factor, with jumps where faces stick or slip, and need not rise.
///
/// A tip that is short of growing after the last growth grows under the next higher load that opens
/// it, even if less load would open it sooner: the load only goes down where tips are beyond
/// growing. Where friction holds the faces when it goes down, unloading does not stop a tip: it
/// grows under the load that is there, with an index above 1.
///
/// After the first growth it goes by steps that let the way of friction be followed: at most half
/// of the factor up, and an eighth of the last growth's down.
class CriticalFactor {
 public:
  /// last, first: factors of the last and of the first growth; 0 before any, when the index is
  /// proportional to the load or nearly so.
  CriticalFactor(double last, double first);

  /// The factor to try.
  double next() const { return next_; }
  /// Tells the greatest index there; 0 if no tip is opened.
  void tell(double index);

  /// The next trial goes on from loads at which nothing grows.
  bool goes_beyond() const { return !last_trial_ && short_of_ && next_ > short_of_->factor; }
  /// The body passes through the last trial, whatever the answer: it lies on the way there.
  bool on_the_way() const { return !virgin_ && !last_trial_ && !(short_of_ && beyond_); }
  /// The answer is the factor of the last growth: the body has gone nowhere from there.
  bool back_at_start() const { return last_trial_ && next_ == start_; }

  /// The last factor that was tried is the answer.
  bool ended() const { return ended_; }
  /// With it a tip grows. Otherwise none does, not even under ten times the last load, or a hundred
  /// times that of the first growth.
  bool grows() const { return grows_; }

 private:
  struct Trial {
    double factor = 0.0;
    double index = 0.0;
  };
  double higher(const Trial& now) const;
  double lower(const Trial& now) const;
  /// The load at which the first trial's index, falling with it, would be 1.
  double proportional() const { return first_.factor / first_.index; }
  bool above_proportional(const Trial& t) const { return t.factor > (1 + 1e-9) * proportional(); }
  /// Friction holds the faces: going down this far has not made the index fall.
  bool holds(const Trial& now) const;
  double between(const Trial& now);
  /// One more trial, there, whatever it shows.
  void end_at(double factor, bool grows);
  void end(bool grows);

  double start_;
  double highest_;  ///< to try
  bool virgin_;     ///< nothing has grown yet
  double next_;
  Trial first_, before_;  ///< no load, no index, to begin with
  std::optional<Trial> short_of_, beyond_;
  int tried_ = 0;
  int halvings_ = 1;       ///< in a row; 0: the last trial was a secant, as the first is to be
  int vain_secants_ = 0;   ///< in a row
  int on_one_side_ = 0;    ///< trials in a row that lay there
  bool end_holds_ = true;  ///< that end has not been found to be far from a jump
  bool last_trial_ = false;
  bool ended_ = false;
  bool grows_ = false;
};

}  // namespace cdca
