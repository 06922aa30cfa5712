// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/contact_solves.hpp"

#include "core/base/errors.hpp"
#include "core/mechanics/face_barrier.hpp"
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

ContactSolves::Balance ContactSolves::balance_faces(double enough, double near) {
  constexpr int most = 150;
  constexpr double agreeing = 1e-3, of_unbalanced = 1e-2;  // limits of friction and pressures
  constexpr double nearly = 1e-4;  // balanced: solves are exact from here on
  ContactPatches& contact = model_.contact();
  std::vector<double>& state = model_.state();
  FaceBarrier faces(contact, model_.contact_spots().compliances(contact, model_.communicator()),
                    gaps(), model_.grid().smallest_side() / model_.spec().material.young);
  Balance balance;
  double left = 1.0;  // of the forces that are out of balance: steps do not go all the way
  std::vector<double> nearest = state;
  double least = 1.0;
  bool built = false;
  given_.anchor = state;  // lest the faces, each a little pressed, drive loose bodies far apart
  const auto solve = [&](const std::vector<ContactAnswer>& answers) {
    for (std::size_t p = 0; p < answers.size(); ++p) contact.patches()[p].now = answers[p];
    if (!built) model_.renew_stiffness(loosest);
    built = true;
    once({1.0, balance.unbalanced > nearly ? of_unbalanced : 0.0});
    return gaps();
  };
  while (!balance.found && balance.steps < most) {
    ++balance.steps;
    built = false;
    const std::vector<double> before = state;
    const double agree = of_unbalanced * balance.unbalanced;
    double share = 0.0;
    try {
      share = faces.step(solve, std::clamp(agree, of_unbalanced * enough, agreeing));
    } catch (const SolveError&) {
      break;  // springs so different that no solve is possible with them
    }
    std::vector<double> move = state;
    for (std::size_t k = 0; k < state.size(); ++k) {
      state[k] = before[k] + share * (state[k] - before[k]);
      move[k] = state[k] - given_.anchor[k];
    }
    left = faces.began_anew() ? 1.0 : (1 - share) * left + share * slowest_.residual;
    balance.unbalanced = faces.unbalanced(gaps());
    if (const double off = std::max(balance.unbalanced, left); off < least) {
      least = off;
      nearest = state;
    }
    const double told_apart = std::max(enough, rounding(faces.largest_pressure()));
    balance.found = std::max(balance.unbalanced, left) <= told_apart;
    if (const double pulled = held_back(move); balance.found && pulled > enough) {
      given_.anchor = state;
      left = pulled;
      balance.found = false;
    }
    if (faces.began_anew() && least <= near) break;
  }
  given_.anchor.clear();
  if (!balance.found) {
    state = nearest;
    balance.unbalanced = least;
  }
  const auto here = gaps();
  contact.respond(here, contact.limits_at(here));
  model_.renew_stiffness(loosest);
  set_forces_of_faces();
  return balance;
}

double ContactSolves::held_back(const std::vector<double>& move) const {
  if (!model_.has_weak_springs() || slowest_.scale == 0.0) return 0.0;
  const CellStiffness& cells = model_.stiffness();
  std::vector<double> weak(std::size_t(cells.count()), 0.0);
  cells.add_spring_forces(move, weak);
  return std::sqrt(cells.dot(weak, weak)) / slowest_.scale;
}

double ContactSolves::rounding(double largest) const {
  if (!model_.has_weak_springs() || !(largest > 0.0)) return 0.0;
  double stiffest = 0.0, farthest = 0.0;
  for (const ContactPatch& p : model_.contact().patches())
    stiffest = std::max(stiffest, model_.contact().law_of(p).normal_stiffness);
  for (const double u : model_.state()) farthest = std::max(farthest, std::abs(u));
  farthest = model_.communicator().max(farthest);
  constexpr double units = 8;  // in the last place, that gaps may be off
  const double off = units * std::numeric_limits<double>::epsilon() * farthest * stiffest;
  return std::min(worst_balance, off / largest);
}

std::vector<ContactGap> ContactSolves::gaps() const {
  return model_.contact_spots().gaps(model_.state(), model_.contact(), model_.communicator());
}

}  // namespace cdca
