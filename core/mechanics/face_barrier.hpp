// SPDX-License-Identifier: BSD-3-Clause
/// All faces at once on the way to balance: each a little open and a little pressed until the end.
#pragma once

#include "core/mechanics/contact_patches.hpp"

#include <functional>
#include <limits>
#include <vector>

namespace cdca {

/// The primal-dual interior-point method with a corrector (S. Mehrotra, SIAM J. Optim. 2, 1992) and
/// centring (J. Gondzio, Comput. Optim. Appl. 6, 1996) for gaps and tractions of the faces. A face
/// that may touch has a pressure p > 0 and an opening s > 0, with s p = b; one that rubs has what
/// is left to its limit on both sides, a > 0, and its slip x > 0 to that side, with x a = b. As b
/// goes to 0, faces become open or pressed, and stick or slip. A step is Newton's for these
/// conditions: each face is a spring that gets stiffer or softer with its part in the whole, so
/// that no face turns from one step to the next, and loose bodies are held by all that is near
/// them.
class FaceBarrier {
 public:
  /// Can all these faces be brought into balance so? Not cohesive ones, which soften.
  static bool suits(const ContactPatches& patches);
  /// compliances: of the body at every patch, m/Pa; gaps: of the state to start from; softness: of
  /// the body over a length like that of a patch, m/Pa. There must be no cohesive faces.
  FaceBarrier(const ContactPatches& patches, const std::vector<double>& compliances,
              const std::vector<ContactGap>& gaps, double softness,
              FrictionLimits limits = FrictionLimits::follow_pressures);

  /// Gaps of a state in which faces answer so, by patch. The springs of the answers are the same in
  /// all solves of a step.
  using Solve = std::function<std::vector<ContactGap>(const std::vector<ContactAnswer>& answers)>;
  /// One step: several solves. agree: how well limits of friction and pressures are to agree, as a
  /// part of the largest. Returns the share of the way to the state of the last solve that is to be
  /// gone.
  double step(const Solve& solve, double agree);

  /// Has the last step ended in a new start? Then body and faces are out of balance by any amount.
  bool began_anew() const { return began_anew_; }

  /// What the steps have come to, by patch.
  std::vector<FaceTraction> tractions() const;

 private:
  /// Two numbers whose product goes to 0, and what the last solve makes of them.
  struct Pair {
    double first = 0.0, second = 0.0;  ///< an opening or a slip, m; what its end keeps up, Pa
    double to_first = 0.0, to_second = 0.0;
    double correction = 0.0;  ///< of their product, for what is not linear in a step
    double product() const { return first * second; }
    double product_at(double share) const;
    double opening_at(double barrier, double end) const;  ///< to_first that goes with a to_second
    double most() const;  ///< share of the change that leaves both positive
    void go(double share);
  };
  /// Gaps with the body's share.
  struct Law {
    double scale = 1.0;       ///< over gaps of the spring alone
    double compliance = 0.0;  ///< of the face and the body, m/Pa
  };
  struct Face {
    std::size_t patch = 0;
    ContactSpec spec;
    bool rubs = false;
    double body = 0.0;  ///< compliance, m/Pa
    Law across, along;
    Pair touch;                ///< opening and pressure
    Pair forwards, backwards;  ///< slips, and what is left to the limit
    double limit = 0.0;        ///< Pa
    double given = -1.0;       ///< limit that stays, Pa; less than 0: it follows the pressure
    double shear = 0.0;        ///< tangential traction, Pa
    double to_shear = 0.0;
    double spring_across() const;  ///< Pa/m, with the body's share
    double spring_along() const;
    double zero_across(double barrier) const;  ///< m, likewise
    double zero_along(double barrier) const;
    double limit_of(double pressure, double friction_share) const;
  };
  /// What a solve aims at.
  struct Aim {
    std::vector<double> corrections, limits;
  };

  std::vector<ContactAnswer> answers() const;
  void follow(const std::vector<ContactGap>& gaps);
  void solve_with_limits(const Solve& solve, double agree);
  void aim_between();
  void aim_at_centre(double share);
  /// Where some pairs are nearly at their end and others are not, steps stay short, and with much
  /// friction there may be no way on from there. All pairs get the same product, at the gaps where
  /// they are, and friction comes back little by little.
  void restart();
  Aim aim() const;
  void aim(const Aim& at);
  double largest_pressure() const;
  double mean() const;
  double most() const;
  std::vector<double> limits() const;
  void keep_limits();
  void note_product();
  /// Those that follow from the pressures of the last solve.
  std::vector<double> limits_there() const;
  template <class Take>
  void for_pairs(const Take& take);
  template <class Take>
  void for_pairs(const Take& take) const;

  std::size_t patches_ = 0;  ///< number of them; those without a law are no faces
  std::vector<Face> faces_;
  double softness_;       ///< m/Pa
  double product_ = 0.0;  ///< of the largest pressure and what it opens in the body, Pa m
  double least_mean_ = std::numeric_limits<double>::infinity();  ///< of products so far, Pa m
  double barrier_ = 0.0;                                         ///< b that a solve aims at, Pa m
  int stuck_ = 0;  ///< steps in a row that have hardly gone anywhere
  int restarts_ = 0;
  bool began_anew_ = false;
  double friction_share_ = 1.0;  ///< that counts
};

}  // namespace cdca
