// SPDX-License-Identifier: BSD-3-Clause
/// Every face for itself against the same soft spring: far from balance, where Newton steps turn
/// one face after the other, this turns all at once.
#pragma once

#include "core/mechanics/contact_patches.hpp"
#include "core/mechanics/fixed_point_mixing.hpp"

#include <vector>

namespace cdca {

/// The alternating direction method of multipliers for gaps and tractions of the faces (J. Douglas
/// and H. H. Rachford, Trans. AMS 82, 1956; D. Gabay and B. Mercier, Comput. Math. Appl. 2, 1976).
/// The body is solved with one spring for all faces, whose zeros move: v = G + t / r is the gap
/// that the spring r would have without its zero, and each face answers to it with the traction t
/// and the gap z that fit its own law, r (v - z) = t. The stiffness stays the same all the time, so
/// that one solve costs little. Friction counts with the pressure of the moment. It comes to rest
/// for any convex law, but slowly where blocks move as a whole; the values v of all faces are mixed
/// with earlier ones, which makes up for it (A. Fu, J. Zhang and S. Boyd, SIAM J. Sci. Comput. 42,
/// 2020), and where that has led farther off, the plain step is taken instead.
class FaceRelaxation {
 public:
  /// compliances: of the body at every patch, m/Pa; gaps: of the state to start from; stiffness: of
  /// the common spring and the body, Pa/m. Open cohesive faces keep the springs that they have.
  FaceRelaxation(const ContactPatches& patches, std::vector<double> compliances,
                 const std::vector<ContactGap>& gaps, double stiffness);

  /// What the faces are to answer with in the next solve: by patch.
  std::vector<ContactAnswer> answers() const;
  /// The gaps that this solve has led to. Returns how far gaps and tractions still are from each
  /// other, as a part of the largest traction; where no face is pressed, of what the common spring
  /// would exert at the widest gap.
  double take(const std::vector<ContactGap>& gaps);
  /// Gaps that the laws are to be asked with, m, and limits of friction, Pa.
  std::vector<ContactGap> gaps() const;
  std::vector<double> limits() const;

 private:
  /// One direction of one face. Its traction and its gap follow from v.
  struct Side {
    double scale = 1.0;       ///< gap with the body's share over that of the face's spring alone
    double compliance = 0.0;  ///< of the face and the body, m/Pa; 0: no spring in this direction
    double gap = 0.0;         ///< z, m, with the body's share
    double traction = 0.0;    ///< t, Pa
    double zero(double spring) const { return gap - traction / spring; }
  };
  struct Face {
    bool relaxed = false;
    double spring = 0.0;  ///< r, Pa/m, with the body's share
    double body = 0.0;    ///< m/Pa
    double limit = 0.0;   ///< of friction, Pa
    Side normal, tangential;
    ContactAnswer kept;  ///< where not relaxed
    ContactGap found;
  };
  /// Sets tractions and gaps of all relaxed sides by their v, m, one side after the other.
  void answer_to(const std::vector<double>& values);

  std::vector<ContactSpec> laws_;  ///< by patch
  std::vector<Face> faces_;
  FixedPointMixing mixing_;
  std::vector<double> plain_;  ///< v of the plain step from where mixing has set out, m
  double before_;              ///< how far v was from at rest there, Pa
};

}  // namespace cdca
