// SPDX-License-Identifier: BSD-3-Clause
/// Faces turn from state to state on the body condensed to them, until they are in balance.
#pragma once

#include "core/mechanics/contact_spots.hpp"
#include "core/mechanics/reference_faces.hpp"

#include <Eigen/Core>
#include <Eigen/LU>

#include <vector>

namespace cdca {

/// Newton's method for the laws of the faces. As long as limits of friction stay, loads, body and
/// faces have a convex potential; with a search along each move, faces get to its lowest point.
/// Where limits follow the pressures there is no potential, but what faces and body exert along a
/// move tells as well how far to go: limits go along in the springs of sliding faces, which settles
/// the last changes, and where this leads nowhere they and the faces take turns. With few
/// changes from a state that is known a turn costs little: there may be hundreds. All is done on
/// the first rank, lest ranks differ by rounding.
class CondensedTurns {
 public:
  struct Rule {
    double enough = 0.0;       ///< balanced: to this part of the largest traction
    bool limits_stay = false;  ///< those that the patches have
  };
  struct Body {
    const std::vector<SpringPlace>& places;
    const Eigen::MatrixXd& compliance;      ///< with closed faces, m^2/N; on the first rank
    const std::vector<ContactGap>& closed;  ///< gaps under the loads with closed faces, m
    ReferenceFaces& reference;              ///< kept from one balance to the next
  };
  /// There must be no cohesive faces. All is borrowed.
  CondensedTurns(const ContactPatches& patches, const Body& body, const Rule& rule);

  struct Found {
    bool found = false;  ///< to within rounding, which the whole body judges
    int turns = 0;
    std::vector<ContactGap> gaps;
    std::vector<FaceTraction> tractions;  ///< that these gaps go with
  };
  /// From gaps that are near, as one may guess. Collective.
  Found find(const std::vector<ContactGap>& from, Communicator& communicator);

 private:
  struct Face {
    std::size_t patch = 0;
    ContactSpec spec;
    Eigen::Index across = -1, along = -1;  ///< places; below 0: there is no spring
  };
  /// Tractions p = k g + given of all places, and what the laws answer to gaps.
  struct Answers {
    Eigen::VectorXd tractions;      ///< Pa
    Eigen::VectorXd springs;        ///< k, Pa/m
    Eigen::VectorXd given;          ///< Pa
    Eigen::VectorXd with_pressure;  ///< k of what is along for the gap across, by place along
  };
  enum class Limits { given, follow };

  Answers answers(Limits limits) const;
  std::vector<double> limits_here() const;
  Eigen::VectorXd tractions_at(const Answers& with, const Eigen::VectorXd& gaps) const;
  /// Springs that a place has less than in the reference, with its length, Pa.
  double softer(const Answers& with, Eigen::Index place) const;
  /// A reference that is near, and gaps with it; false where there is none.
  bool lay_reference(const Answers& with);
  /// Places that are not as in the reference, and the factor for what they exert less, q:
  /// g = h + C_R q with q = less_at(g).
  struct Others {
    std::vector<Eigen::Index> places, at;   ///< at: their columns of C_R
    std::vector<Eigen::Index> across;       ///< of the same faces
    Eigen::VectorXd softer, with_pressure;  ///< than there, with their lengths, Pa
    Eigen::PartialPivLU<Eigen::MatrixXd> factor;
  };
  Others others(const Answers& with) const;
  /// What these exert less than in the reference at such gaps, besides given tractions, N/m.
  Eigen::VectorXd less_at(const Others& others,
                          const Eigen::Ref<const Eigen::VectorXd>& gaps) const;
  /// From gaps as the reference has them. given: tractions that places exert more than there, Pa.
  Eigen::VectorXd moved(const Others& others, Eigen::VectorXd gaps,
                        const Eigen::VectorXd& given) const;
  /// Gaps with such springs; false where these do not hold the body.
  bool solve(const Answers& with, Eigen::VectorXd& gaps);
  /// Share of the way to gaps and tractions `there` at which all is in balance along the way.
  double share_of_move(const Eigen::VectorXd& gaps_there, const Eigen::VectorXd& tractions_there,
                       Limits limits);
  /// To where springs as of `from` lead, or a share of that way; false where they hold no body.
  bool turn(const Answers& from, Limits limits);
  double off_from(const Answers& wanted) const;
  bool is_enough(double off, double before) const;
  /// Where the body comes to from the gaps at hand while faces hold on to each other.
  void start();
  bool settle_at_limits();
  bool settle_with_pressures();
  bool settle();
  double limit_at_gap(const Face& face) const;

  Rule rule_;
  Body body_;
  std::vector<Face> faces_;
  std::vector<Eigen::Index> across_of_;  ///< by place along: that across the same face
  Eigen::VectorXd lengths_, scales_, closed_springs_, closed_gaps_;
  std::vector<double> limits_;         ///< by face, Pa
  Eigen::VectorXd gaps_;               ///< with the body's share, m
  Eigen::VectorXd tractions_;          ///< that the body is in balance with, Pa
  Eigen::VectorXd base_, base_given_;  ///< gaps with the reference's springs, and given tractions
  bool downhill_ = true;               ///< the last move: by more than rounding
  bool rounded_ = false;               ///< settled as well as rounding allows
  bool refines_ = false;               ///< solves: where rounding may count
  int turns_ = 0;
};

}  // namespace cdca
