// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/held_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cdca {

HeldFaces::HeldFaces(const ContactPatches& patches, const std::vector<double>& compliances,
                     double softness, FrictionLimits limits)
    : patches_(patches.patches().size()), softness_(softness) {
  for (std::size_t k = 0; k < patches_; ++k) {
    const ContactPatch& patch = patches.patches()[k];
    const ContactSpec& spec = patches.law_of(patch);
    if (spec.law == ContactLaw::none || spec.normal_stiffness <= 0.0) continue;
    faces_.push_back({k, spec, compliances[k]});
    if (limits == FrictionLimits::stay) faces_.back().given = patch.limit;
  }
}

std::vector<ContactAnswer> HeldFaces::closed() const {
  std::vector<ContactAnswer> answers(patches_);
  for (const Face& face : faces_) {
    ContactAnswer& a = answers[face.patch];
    a.state = ContactState::stick;
    a.normal_spring = face.spec.normal_stiffness;
    if (can_rub(face.spec)) a.tangential_spring = face.spec.tangential_stiffness;
  }
  return answers;
}

std::vector<ContactAnswer> HeldFaces::exerting(const std::vector<FaceTraction>& tractions,
                                               const std::vector<ContactGap>& gaps) const {
  auto answers = closed();
  for (const Face& face : faces_) {
    ContactAnswer& a = answers[face.patch];
    // zeros are gaps with the body's share
    const auto zero = [&](double spring, double gap, double traction) {
      return (1 + face.body * spring) * gap - (1 / spring + face.body) * traction;
    };
    const ContactGap& gap = gaps[face.patch];
    const FaceTraction& traction = tractions[face.patch];
    a.normal_zero = zero(a.normal_spring, gap.normal, traction.normal);
    if (a.tangential_spring > 0.0)
      a.tangential_zero = zero(a.tangential_spring, gap.tangential, traction.tangential);
  }
  return answers;
}

std::vector<FaceTraction> HeldFaces::at(const std::vector<ContactGap>& to,
                                        std::vector<FaceTraction> tractions,
                                        const std::vector<ContactGap>& from) const {
  for (const Face& face : faces_) {
    FaceTraction& traction = tractions[face.patch];
    const ContactGap &before = from[face.patch], &now = to[face.patch];
    traction.normal += face.spec.normal_stiffness * (now.normal - before.normal);
    if (can_rub(face.spec))
      traction.tangential += face.spec.tangential_stiffness * (now.tangential - before.tangential);
  }
  return tractions;
}

double HeldFaces::unbalanced(const std::vector<FaceTraction>& tractions,
                             const std::vector<ContactGap>& gaps) const {
  double most = 0.0, largest = 0.0, widest = std::numeric_limits<double>::min();
  for (const Face& face : faces_) {
    const ContactGap& gap = gaps[face.patch];
    widest = std::max(widest, gap.normal);
    const double limit = face.given >= 0.0 ? face.given : limit_at(face.spec, gap.normal);
    const ContactAnswer a = contact_answer(face.spec, 0.0, gap, limit);
    const FaceTraction& is = tractions[face.patch];
    most = std::max({most, std::abs(a.normal - is.normal), std::abs(a.tangential - is.tangential)});
    largest = std::max({largest, std::abs(a.normal), std::abs(a.tangential)});
  }
  // where all are open, what they still exert is measured by what would close them
  return most / std::max(most, largest > 0.0 ? largest : widest / softness_);
}

}  // namespace cdca
