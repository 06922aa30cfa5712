// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/contact_solves.hpp"

#include "core/base/errors.hpp"
#include "core/mechanics/fixed_point_mixing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
  slowest_.converged = report.converged;
  slowest_.rounded = report.rounded;
  slowest_.iterations = std::max(slowest_.iterations, report.iterations);
  slowest_.residual = report.residual;
  slowest_.scale = report.scale;
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

void ContactSolves::answer(const std::vector<ContactAnswer>& answers) {
  for (std::size_t p = 0; p < answers.size(); ++p) model_.contact().patches()[p].now = answers[p];
}

double ContactSolves::held_back(const std::vector<double>& move) const {
  if (!model_.has_weak_springs()) return 0.0;
  const double all = loads();
  if (all == 0.0) return 0.0;
  const CellStiffness& cells = model_.stiffness();
  std::vector<double> weak(std::size_t(cells.count()), 0.0);
  cells.add_spring_forces(move, weak);
  return std::sqrt(cells.dot(weak, weak)) / all;
}

double ContactSolves::loads() const {
  const CellStiffness& cells = model_.stiffness();
  std::vector<double> forces = given_.external;
  cells.subtract_held(given_.held, forces);
  cells.clear_held(forces);
  const double sum = cells.dot(forces, forces);
  // nothing is loaded: what the faces have locked in
  return sum > 0.0 ? std::sqrt(sum) : slowest_.scale;
}

double ContactSolves::rounding(double largest, double worst) const {
  if (!model_.has_weak_springs() || !(largest > 0.0)) return 0.0;
  double stiffest = 0.0, farthest = 0.0;
  for (const ContactPatch& p : model_.contact().patches())
    stiffest = std::max(stiffest, model_.contact().law_of(p).normal_stiffness);
  for (const double u : model_.state()) farthest = std::max(farthest, std::abs(u));
  farthest = model_.communicator().max(farthest);
  constexpr double units = 8;  // in the last place, that gaps may be off
  const double off = units * std::numeric_limits<double>::epsilon() * farthest * stiffest;
  // what faces that hardly touch are out of balance may be less than any solve leaves
  constexpr double of_tolerance = 0.1, most = 1e-2;
  const double left =
      of_tolerance * model_.spec().solver.tolerance * loads() / model_.grid().smallest_side();
  return std::max(std::min(worst, off / largest), std::min(most, left / largest));
}

std::vector<ContactGap> ContactSolves::gaps() const {
  return model_.contact_spots().gaps(model_.state(), model_.contact(), model_.communicator());
}

}  // namespace cdca
