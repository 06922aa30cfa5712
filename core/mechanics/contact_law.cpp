// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/contact_law.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

namespace {

/// The steep branch of cohesive faces ends at this part of the critical gap.
constexpr double steep_part = 0.01;

/// Traction on the envelope of Eq. 12 at opening g > 0.
double envelope(const ContactSpec& s, double g) {
  const double peak_at = steep_part * s.critical_gap;
  const double peak = s.cohesive_stiffness * (s.critical_gap - peak_at);
  if (g < peak_at) return peak * g / peak_at;
  return std::max(0.0, s.cohesive_stiffness * (s.critical_gap - g));
}

ContactAnswer opened(const ContactSpec& s, double largest, double gap, double secant_at) {
  ContactAnswer a;
  if (s.law != ContactLaw::cohesive) return a;
  a.largest = std::max(largest, secant_at);
  // the secant, so that the solve stays definite; unloading goes to the origin
  const double from = std::max(a.largest, 1e-3 * steep_part * s.critical_gap);
  a.normal_spring = envelope(s, from) / from;
  a.normal = a.normal_spring * gap;
  if (a.normal_spring > 0.0) a.state = ContactState::stick;
  return a;
}

}  // namespace

bool can_rub(const ContactSpec& s) {
  return s.law == ContactLaw::coulomb && s.tangential_stiffness > 0.0 &&
         (s.friction > 0.0 || s.cohesion > 0.0);
}

double limit_at(const ContactSpec& s, double gap) {
  if (gap > 0.0) return s.law == ContactLaw::cohesive ? s.normal_stiffness * gap : 0.0;
  return s.friction * s.normal_stiffness * -gap + s.cohesion;
}

ContactAnswer contact_answer(const ContactSpec& s, double largest, const ContactGap& gap,
                             double limit) {
  ContactAnswer a;
  if (s.law == ContactLaw::none) return a;
  const bool open = gap.normal > 0.0;
  if (open) {
    a = opened(s, largest, gap.normal, limit / s.normal_stiffness);
    if (s.law == ContactLaw::cohesive) return a;
  } else {
    a.largest = largest;
    a.normal_spring = s.normal_stiffness;
    a.normal = s.normal_stiffness * gap.normal;
    a.state = ContactState::slip;
  }
  if (s.law == ContactLaw::frictionless || s.tangential_stiffness <= 0.0) return a;
  const double trial = s.tangential_stiffness * gap.tangential;
  if (std::abs(trial) < limit || (!open && trial == 0.0)) {
    a.tangential = trial;
    a.tangential_spring = s.tangential_stiffness;
    if (!open) a.state = ContactState::stick;
    return a;
  }
  a.tangential = std::copysign(limit, trial);
  return a;
}

ContactAnswer touching(const ContactSpec& s) {
  return s.law == ContactLaw::none ? ContactAnswer() : contact_answer(s, 0.0, {}, 0.0);
}

}  // namespace cdca
