// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/contact_solves.hpp"

#include "core/mechanics/face_relaxation.hpp"
#include "core/mechanics/fixed_point_mixing.hpp"

#include <algorithm>

namespace cdca {

namespace {

/// A solve in a row of them need only be as exact as the change is large: this part of it.
constexpr double of_change = 0.05;

}  // namespace

void ContactSolves::set_forces_of_faces() {
  std::fill(given_.faces.begin(), given_.faces.end(), 0.0);
  model_.add_contact_forces(given_.faces);
}

void ContactSolves::once(const Accuracy& accuracy) {
  set_forces_of_faces();
  const SolverReport report = solve_once(model_, solver_, load_factor_, given_, accuracy);
  ++count_;
  if (quickest_ == 0 || report.iterations < quickest_) quickest_ = report.iterations;
  lost_ += report.iterations - quickest_;
  slowest_.converged = report.converged;
  slowest_.rounded = report.rounded;
  slowest_.iterations = std::max(slowest_.iterations, report.iterations);
  slowest_.residual = report.residual;
  slowest_.scale = report.scale;
}

void ContactSolves::build_stiffness(double weak) {
  model_.build_stiffness(weak);
  quickest_ = lost_ = 0;
}

void ContactSolves::turn_springs(double weak) {
  constexpr int worth_a_build = 30;  // iterations that take as long
  constexpr std::size_t few = 4;     // patches; each may cost some iterations in every solve
  const bool one_factor = model_.hierarchy().count() == 1;
  if (one_factor && lost_ < worth_a_build && model_.turned_patches() <= few) {
    model_.turn_springs(weak);
  } else {
    build_stiffness(weak);
  }
}

void ContactSolves::turn_limits(double agreed, double part) {
  constexpr int most = 10;
  constexpr std::size_t kept = 5;  // of these turns
  ContactPatches& contact = model_.contact();
  FixedPointMixing turns(kept);
  for (int k = 0; k < most; ++k) {
    const auto found = contact.limits_of_sliding(gaps());
    if (found.off <= agreed) return;
    std::vector<double> limits = turns.next(contact.limits(), found.limits);
    for (double& limit : limits) limit = std::max(0.0, limit);
    contact.slide_at(limits);
    once({0.1 * part, of_change});
  }
}

double ContactSolves::relax_faces(double enough, double weak) {
  constexpr int most = 1000;
  ContactPatches& contact = model_.contact();
  // about that of a block of a few elements: neither faces nor body count alone
  const double stiffness = 0.3 * model_.spec().material.young / model_.grid().smallest_side();
  FaceRelaxation faces(contact, model_.contact_spots().compliances(contact, model_.communicator()),
                       gaps(), stiffness);
  double off = 1.0;
  for (int k = 0; k < most && off > enough; ++k) {
    const auto answers = faces.answers();
    for (std::size_t p = 0; p < answers.size(); ++p) contact.patches()[p].now = answers[p];
    if (k == 0) build_stiffness(weak);
    once({1.0, of_change});
    off = faces.take(gaps());
  }
  contact.respond(faces.gaps(), faces.limits());
  build_stiffness(weak);
  set_forces_of_faces();
  return off;
}

std::vector<ContactGap> ContactSolves::gaps() const {
  return model_.contact_spots().gaps(model_.state(), model_.contact(), model_.communicator());
}

}  // namespace cdca
