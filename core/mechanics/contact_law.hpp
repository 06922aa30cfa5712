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

/// What a patch of faces remembers from one equilibrium to the next.
struct ContactHistory {
  double slip = 0.0;     ///< m, that does not come back on unloading
  double largest = 0.0;  ///< m, largest opening so far; cohesive faces
};

/// The answer of a patch to its mean gap. Tractions as stresses: tension positive; the tangential
/// one is positive when the plus face is pulled back against the crack's direction.
struct ContactAnswer {
  ContactState state = ContactState::open;
  double normal = 0.0;      ///< Pa
  double tangential = 0.0;  ///< Pa
  /// Springs that give these tractions in the next solve: normal = normal_spring g_N,
  /// tangential = tangential_spring g_T + offset.
  double normal_spring = 0.0;      ///< Pa/m
  double tangential_spring = 0.0;  ///< Pa/m
  double offset = 0.0;             ///< Pa
  ContactHistory history;          ///< after this equilibrium, should it be accepted
};

/// Eq. 10-13 with a return mapping in the tangential direction: in slip the traction keeps the
/// direction of the trial traction, t = (mu |p_N| + c_c) p_trial / |p_trial|.
/// g_N > 0 is open. Cohesive faces: Eq. 12 jumps at g_N = 0; here the traction climbs to k_C g_C
/// over a hundredth of g_C, softens as Eq. 12 says, and goes back to the origin on unloading.
ContactAnswer contact_answer(const ContactSpec& spec, const ContactHistory& history,
                             double g_normal, double g_tangential);

/// Faces that have not been looked at yet: they touch and stick.
ContactAnswer touching(const ContactSpec& spec, const ContactHistory& history);

}  // namespace cdca
