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

ContactAnswer opened(const ContactSpec& s, const ContactHistory& history, double g) {
  ContactAnswer a;
  a.history = history;
  if (s.law != ContactLaw::cohesive) return a;
  a.history.largest = std::max(history.largest, g);
  // the secant, so that the solve stays definite; unloading goes to the origin
  const double from = std::max(a.history.largest, 1e-3 * steep_part * s.critical_gap);
  a.normal_spring = envelope(s, from) / from;
  a.normal = a.normal_spring * g;
  if (a.normal_spring > 0.0) a.state = ContactState::stick;
  return a;
}

}  // namespace

ContactAnswer contact_answer(const ContactSpec& s, const ContactHistory& history, double g_normal,
                             double g_tangential) {
  if (s.law == ContactLaw::none || g_normal > 0.0) return opened(s, history, g_normal);
  ContactAnswer a;
  a.history = history;
  a.normal_spring = s.normal_stiffness;
  a.normal = s.normal_stiffness * g_normal;
  a.state = ContactState::slip;
  if (s.law == ContactLaw::frictionless) {
    a.history.slip = g_tangential;
    return a;
  }
  const double trial = s.tangential_stiffness * (g_tangential - history.slip);
  const double limit = s.friction * std::abs(a.normal) + s.cohesion;
  if (std::abs(trial) <= limit) {
    a.state = ContactState::stick;
    a.tangential = trial;
    a.tangential_spring = s.tangential_stiffness;
    a.offset = -s.tangential_stiffness * history.slip;
    return a;
  }
  a.tangential = a.offset = std::copysign(limit, trial);
  a.history.slip = g_tangential - a.tangential / s.tangential_stiffness;
  return a;
}

ContactAnswer touching(const ContactSpec& s, const ContactHistory& history) {
  if (s.law == ContactLaw::none) return {};
  return contact_answer(s, history, 0.0, history.slip);
}

}  // namespace cdca
