// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/stuck_faces.hpp"

#include <utility>

namespace cdca {

namespace {

/// The springs of a face that touches and holds on to the other one, whatever friction can hold.
ContactAnswer stuck(const ContactSpec& law) {
  constexpr double usual = 0.1;  // of the normal stiffness
  ContactAnswer answer;
  answer.state = ContactState::stick;
  answer.normal_spring = law.normal_stiffness;
  answer.tangential_spring =
      law.tangential_stiffness > 0.0 ? law.tangential_stiffness : usual * law.normal_stiffness;
  return answer;
}

/// Faces that touch are stuck, and exert what they do now. gaps: where they are now. compliances:
/// of the body at every patch, m/Pa.
void stick(ContactPatches& contact, const std::vector<ContactGap>& gaps,
           const std::vector<double>& compliances) {
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    ContactPatch& p = contact.patches()[k];
    const ContactSpec& law = contact.law_of(p);
    if (p.now.state == ContactState::open || law.law == ContactLaw::cohesive) continue;
    const ContactAnswer before = std::exchange(p.now, stuck(law));
    // zeros are gaps with the body's share; those of springs that the law has come without it
    const auto zero = [&](double spring, double of_law, double gap, double traction) {
      return (1 + of_law * compliances[k]) * gap - (1 / spring + compliances[k]) * traction;
    };
    p.now.normal_zero =
        zero(p.now.normal_spring, law.normal_stiffness, gaps[k].normal, before.normal);
    p.now.tangential_zero = zero(p.now.tangential_spring, law.tangential_stiffness,
                                 gaps[k].tangential, before.tangential);
  }
}

/// Opens stuck faces that would have to pull, and sticks open ones that would overlap; false if
/// there are none.
bool open_or_stick(ContactPatches& contact, const std::vector<ContactGap>& gaps,
                   const std::vector<double>& compliances) {
  bool any = false;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    ContactPatch& p = contact.patches()[k];
    const ContactSpec& law = contact.law_of(p);
    if (law.law == ContactLaw::cohesive || law.law == ContactLaw::none) continue;
    const bool open = p.now.state == ContactState::open;
    const double gap = (1 + law.normal_stiffness * compliances[k]) * gaps[k].normal;
    if (open == (gap > p.now.normal_zero)) continue;
    p.now = open ? stuck(law) : ContactAnswer();
    any = true;
  }
  return any;
}

}  // namespace

Equilibrium::BeforeCreep load_with_stuck_faces(Model& model, ContactSolves& solves,
                                               const Forces& given,
                                               const std::vector<ContactGap>& gaps) {
  constexpr int most = 20;
  ContactPatches& contact = model.contact();
  const auto compliances = model.contact_spots().compliances(contact, model.communicator());
  stick(contact, gaps, compliances);
  for (int k = 0; k < most; ++k) {
    model.renew_stiffness();
    solves.once({});
    if (!open_or_stick(contact, solves.gaps(), compliances)) break;
  }
  return {model.state(), support_forces(model, given, inner_forces(model))};
}

}  // namespace cdca
