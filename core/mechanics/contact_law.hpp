// SPDX-License-Identifier: BSD-3-Clause
/// What touching crack faces do to each other (2.3).
#pragma once

#include <cstdint>

namespace cdca {

enum class ContactLaw { none, frictionless, coulomb, cohesive };

/// The law of the faces of one crack; stiffness per area, Pa/m.
struct ContactSpec {
  ContactLaw law = ContactLaw::none;
  double normal_stiffness = 0.0;
  double tangential_stiffness = 0.0;
  double friction = 0.0;
  double cohesion = 0.0;            ///< Pa
  double cohesive_stiffness = 0.0;  ///< of the softening branch, Pa/m
  double critical_gap = 0.0;        ///< m
};

enum class ContactState : std::int32_t { open, stick, slip };

/// What a patch is asked with: means over it, m. The gap of a spring is its traction over its
/// stiffness.
struct ContactGap {
  double normal = 0.0;      ///< > 0: open
  double tangential = 0.0;  ///< of a spring that stands where the faces stuck last
};

/// The answer of a patch to its mean gap. Tractions as stresses: tension positive; the tangential
/// one is positive when the plus face is pulled back against the crack's direction.
struct ContactAnswer {
  ContactState state = ContactState::open;
  double normal = 0.0;      ///< Pa
  double tangential = 0.0;  ///< Pa
  /// Springs that give these tractions in the next solve, Pa/m. Faces that slide have no tangential
  /// spring: their traction is given.
  double normal_spring = 0.0;
  double tangential_spring = 0.0;
  /// Gaps (m, with the body's share) where these springs exert nothing; other than 0 in
  /// steps of FaceBarrier, and where faces are held.
  double normal_zero = 0.0;
  double tangential_zero = 0.0;
  double largest = 0.0;  ///< m, opening so far should this equilibrium be accepted; cohesive faces
};

/// Do faces that touch exert shear?
bool can_rub(const ContactSpec& spec);

/// What limits of friction do while faces settle.
enum class FrictionLimits { follow_pressures, stay };

/// What the faces of a patch do to each other, Pa; as in ContactAnswer.
struct FaceTraction {
  double normal = 0.0, tangential = 0.0;
};

/// What an answer keeps to that depends on the normal gap (m), Pa: of friction mu |p_N| + c_c; of
/// open cohesive faces the opening where their secant is taken, times k_N.
double limit_at(const ContactSpec& spec, double gap);

/// Eq. 10-13 with a return mapping in the tangential direction: in slip the traction keeps the
/// direction of the trial traction, t = limit p_trial / |p_trial|.
/// Cohesive faces: Eq. 12 jumps at g_N = 0; here the traction climbs to k_C g_C over a hundredth of
/// g_C, softens as Eq. 12 says, and goes back to the origin on unloading. largest: their largest
/// opening so far, m.
ContactAnswer contact_answer(const ContactSpec& spec, double largest, const ContactGap& gap,
                             double limit);

/// Faces that have not been looked at yet: they touch and stick.
ContactAnswer touching(const ContactSpec& spec);

}  // namespace cdca
