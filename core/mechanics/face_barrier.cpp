// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/face_barrier.hpp"

#include "core/mechanics/fixed_point_mixing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cdca {

namespace {

constexpr double tiny = std::numeric_limits<double>::min();
/// Pairs may go that part of the way to where one of them would be 0.
constexpr double nearly_all = 0.99;
/// No pressure is less than that part of the largest, lest products run out of numbers. Far less
/// than rounding: the faces that are wide open must not hold up the others.
constexpr double nothing = 1e-25;
/// A step that goes less far is hardly one; after so many of them there is a new start.
constexpr double hardly = 0.1;
constexpr int most_stuck = 2;
/// Least pressures at the start, as a part of the largest.
constexpr double at_start = 0.1;
/// Share of friction that counts first after a new start, and what comes to it in a step that goes
/// far.
constexpr double least_friction = 0.1, more_friction = 0.05, far_enough = 0.5;

}  // namespace

double FaceBarrier::Pair::product_at(double share) const {
  return (first + share * (to_first - first)) * (second + share * (to_second - second));
}

double FaceBarrier::Pair::opening_at(double barrier, double end) const {
  // first second + d first second + first d second = b
  return (barrier - correction + first * (second - end)) / second;
}

double FaceBarrier::Pair::most() const {
  double share = 1.0;
  if (to_first < 0.0) share = std::min(share, first / (first - to_first));
  if (to_second < 0.0) share = std::min(share, second / (second - to_second));
  return share;
}

void FaceBarrier::Pair::go(double share) {
  first += share * (to_first - first);
  second += share * (to_second - second);
  correction = 0.0;
}

double FaceBarrier::Face::spring_across() const {
  return touch.second / (touch.first + across.compliance * touch.second);
}

double FaceBarrier::Face::spring_along() const {
  return 1 /
         (along.compliance + forwards.first / forwards.second + backwards.first / backwards.second);
}

double FaceBarrier::Face::zero_across(double barrier) const {
  return touch.opening_at(barrier, 0.0);
}

double FaceBarrier::Face::zero_along(double barrier) const {
  return forwards.opening_at(barrier, limit) - backwards.opening_at(barrier, limit);
}

double FaceBarrier::Face::limit_of(double pressure, double friction_share) const {
  if (given >= 0.0) return given;
  // open faces have no cohesion
  const double pressed = across.compliance * touch.second;
  const double cohesion = spec.cohesion * pressed / (pressed + touch.first);
  return friction_share * (spec.friction * pressure + cohesion);
}

bool FaceBarrier::suits(const ContactPatches& patches) {
  return std::none_of(patches.patches().begin(), patches.patches().end(), [&](const auto& patch) {
    return patches.law_of(patch).law == ContactLaw::cohesive;
  });
}

FaceBarrier::FaceBarrier(const ContactPatches& patches, const std::vector<double>& compliances,
                         const std::vector<ContactGap>& gaps, double softness,
                         FrictionLimits limits)
    : patches_(patches.patches().size()), softness_(softness) {
  double largest = 0.0, widest = 0.0;
  for (std::size_t k = 0; k < patches.patches().size(); ++k) {
    const ContactPatch& patch = patches.patches()[k];
    const ContactSpec& spec = patches.law_of(patch);
    if (spec.law == ContactLaw::none || spec.normal_stiffness <= 0.0) continue;
    Face face;
    face.patch = k;
    face.spec = spec;
    face.body = compliances[k];
    const auto law = [&](double spring) {
      return Law{1 + face.body * spring, 1 / spring + face.body};
    };
    face.across = law(spec.normal_stiffness);
    face.rubs = can_rub(spec);
    if (limits == FrictionLimits::stay) {
      face.given = patch.limit;
      face.rubs = face.rubs && patch.limit > 0.0;
    }
    if (face.rubs) face.along = law(spec.tangential_stiffness);
    largest = std::max(largest, -patch.now.normal);
    widest = std::max(widest, std::abs(gaps[k].normal * face.across.scale));
    faces_.push_back(face);
  }
  // a body at rest does not tell: anything will do, at the price of more steps
  if (largest == 0.0) largest = widest > 0.0 ? widest / softness : 1.0;
  const double pressure = at_start * largest;
  const double opening = pressure * softness;
  for (Face& face : faces_) {
    const ContactAnswer& now = patches.patches()[face.patch].now;
    const ContactGap& gap = gaps[face.patch];
    face.touch.first = std::max(gap.normal * face.across.scale, opening);
    face.touch.second = std::max(-now.normal, pressure);
    if (!face.rubs) continue;
    face.limit = face.limit_of(face.touch.second, friction_share_);
    face.shear = std::clamp(now.tangential, -0.9 * face.limit, 0.9 * face.limit);
    const double slip = gap.tangential * face.along.scale - face.along.compliance * face.shear;
    face.forwards.first = std::max(slip, opening);
    face.forwards.second = face.limit - face.shear;
    face.backwards.first = std::max(-slip, opening);
    face.backwards.second = face.limit + face.shear;
  }
}

template <class Take>
void FaceBarrier::for_pairs(const Take& take) {
  for (Face& face : faces_) {
    take(face.touch);
    if (face.rubs) take(face.forwards), take(face.backwards);
  }
}

template <class Take>
void FaceBarrier::for_pairs(const Take& take) const {
  for (const Face& face : faces_) {
    take(face.touch);
    if (face.rubs) take(face.forwards), take(face.backwards);
  }
}

double FaceBarrier::mean() const {
  double sum = 0.0, count = 0.0;
  for_pairs([&](const Pair& p) { sum += p.product(), count += 1; });
  return count > 0.0 ? sum / count : 0.0;
}

double FaceBarrier::largest_pressure() const {
  double largest = 0.0;
  for (const Face& face : faces_) largest = std::max(largest, face.touch.second);
  return largest;
}

double FaceBarrier::most() const {
  double share = 1.0;
  for_pairs([&](const Pair& p) { share = std::min(share, p.most()); });
  return share;
}

std::vector<double> FaceBarrier::limits() const {
  std::vector<double> limits;
  for (const Face& face : faces_) limits.push_back(face.limit);
  return limits;
}

std::vector<double> FaceBarrier::limits_there() const {
  std::vector<double> limits;
  for (const Face& face : faces_)
    limits.push_back(face.rubs ? face.limit_of(face.touch.to_second, friction_share_) : 0.0);
  return limits;
}

FaceBarrier::Aim FaceBarrier::aim() const {
  Aim now;
  for_pairs([&](const Pair& p) { now.corrections.push_back(p.correction); });
  now.limits = limits();
  return now;
}

void FaceBarrier::aim(const Aim& at) {
  auto next = at.corrections.begin();
  for_pairs([&](Pair& p) { p.correction = *next++; });
  for (std::size_t k = 0; k < faces_.size(); ++k) faces_[k].limit = at.limits[k];
}

std::vector<ContactAnswer> FaceBarrier::answers() const {
  std::vector<ContactAnswer> answers(patches_);
  for (const Face& face : faces_) {
    ContactAnswer& a = answers[face.patch] = {};
    a.state = ContactState::stick;
    a.normal_spring = 1 / (1 / face.spring_across() - face.body);
    a.normal_zero = face.zero_across(barrier_);
    if (!face.rubs) continue;
    a.tangential_spring = 1 / (1 / face.spring_along() - face.body);
    a.tangential_zero = face.zero_along(barrier_);
  }
  return answers;
}

std::vector<FaceTraction> FaceBarrier::tractions() const {
  std::vector<FaceTraction> tractions(patches_);
  for (const Face& face : faces_) tractions[face.patch] = {-face.touch.second, face.shear};
  return tractions;
}

void FaceBarrier::follow(const std::vector<ContactGap>& gaps) {
  for (Face& face : faces_) {
    const ContactGap& gap = gaps[face.patch];
    const double across = gap.normal * face.across.scale - face.zero_across(barrier_);
    face.touch.to_second = -face.spring_across() * across;
    face.touch.to_first = face.touch.opening_at(barrier_, face.touch.to_second);
    if (!face.rubs) continue;
    const double along = gap.tangential * face.along.scale - face.zero_along(barrier_);
    face.to_shear = face.spring_along() * along;
    face.forwards.to_second = face.limit - face.to_shear;
    face.backwards.to_second = face.limit + face.to_shear;
    for (Pair* slip : {&face.forwards, &face.backwards})
      slip->to_first = slip->opening_at(barrier_, slip->to_second);
  }
}

void FaceBarrier::solve_with_limits(const Solve& solve, double agree) {
  constexpr int most = 15;
  constexpr std::size_t kept = 20;
  FixedPointMixing turns(kept);
  for (int k = 0;; ++k) {
    follow(solve(answers()));
    const auto tried = limits(), found = limits_there();
    double change = 0.0, largest = 0.0;
    for (std::size_t n = 0; n < found.size(); ++n) {
      change = std::max(change, std::abs(found[n] - tried[n]));
      largest = std::max(largest, std::abs(found[n]));
    }
    if (change <= agree * largest || k == most) return;
    const auto next = turns.next(tried, found);
    for (std::size_t n = 0; n < next.size(); ++n) faces_[n].limit = next[n];
  }
}

void FaceBarrier::aim_between() {
  // the farther a step can go to b = 0, the less is left for the next b (Mehrotra)
  const double share = most(), before = mean();
  double sum = 0.0, count = 0.0;
  for_pairs([&](const Pair& p) { sum += p.product_at(share), count += 1; });
  const double ratio = before > 0.0 ? std::max(0.0, sum / count) / before : 0.0;
  barrier_ = before * ratio * ratio * ratio;
  if (stuck_ > 0) barrier_ = std::max(barrier_, 0.5 * before);
  if (friction_share_ < 1.0) barrier_ = before;
  const double trust = stuck_ > 0 ? 0.0 : share * share;
  for_pairs(
      [&](Pair& p) { p.correction = trust * (p.to_first - p.first) * (p.to_second - p.second); });
}

void FaceBarrier::aim_at_centre(double share) {
  constexpr double low = 0.1, high = 10;  // of b: products outside hold up the next steps
  for_pairs([&](Pair& p) {
    const double product = p.product_at(share);
    const double wanted = std::clamp(product, low * barrier_, high * barrier_);
    p.correction -= std::max(wanted - product, -high * barrier_);
  });
}

void FaceBarrier::note_product() {
  const double now = mean();
  if (now >= least_mean_) return;
  least_mean_ = now;
  const double largest = largest_pressure();
  product_ = largest * largest * softness_;
}

void FaceBarrier::keep_limits() {
  for (Face& face : faces_) {
    if (face.rubs) face.limit = face.limit_of(face.touch.second, friction_share_);
  }
}

double FaceBarrier::step(const Solve& solve, double agree) {
  constexpr double roughly = 1e-2;
  constexpr int most_centrings = 2;
  constexpr double far = 0.9, farther = 0.3, gain = 0.01;  // shares of the way
  barrier_ = 0.0;
  solve_with_limits(solve, std::max(agree, roughly));
  aim_between();
  solve_with_limits(solve, agree);
  double share = most();
  for (int k = 0; k < most_centrings && share < far; ++k) {
    const Aim before = aim();
    aim_at_centre(std::min(1.0, share + farther));
    solve_with_limits(solve, agree);
    if (most() < share + gain) {
      aim(before);
      follow(solve(answers()));
      break;
    }
    share = most();
  }
  share = std::min(1.0, nearly_all * share);
  const double pressure = nothing * largest_pressure(), opening = pressure * softness_;
  for_pairs([&](Pair& p) {
    p.go(share);
    p.first = std::max(p.first, opening);
    p.second = std::max(p.second, pressure);
  });
  for (Face& face : faces_) face.shear += share * (face.to_shear - face.shear);
  if (share > far_enough) friction_share_ = std::min(1.0, friction_share_ + more_friction);
  keep_limits();
  note_product();
  stuck_ = share < hardly ? stuck_ + 1 : 0;
  began_anew_ = stuck_ == most_stuck;
  if (began_anew_) restart();
  return share;
}

void FaceBarrier::restart() {
  // twice a little above where it is, then nearly from the start
  constexpr int gently = 2;
  constexpr double rounding = 1e-15;
  constexpr double least = 1e-8, greater = 1e3, more = 100, full = 1e-2;
  double product = full * product_;
  if (restarts_ < gently) {
    product = std::max(more * mean(), least * std::pow(greater, restarts_) * product_);
  } else {
    friction_share_ = least_friction;
  }
  ++restarts_;
  stuck_ = 0;
  for (Face& face : faces_) {
    const double c = face.across.compliance, gap = face.touch.first - c * face.touch.second;
    const double root = std::sqrt(gap * gap + 4 * c * product);
    face.touch.second = gap > 0.0 ? 2 * product / (gap + root) : (root - gap) / (2 * c);
    face.touch.first = product / face.touch.second;
    if (!face.rubs) continue;
    face.limit = face.limit_of(face.touch.second, friction_share_);
    const double along =
        face.along.compliance * face.shear + face.forwards.first - face.backwards.first;
    double low = -face.limit, high = face.limit;
    for (int k = 0; k < std::numeric_limits<double>::digits; ++k) {
      face.shear = 0.5 * (low + high);
      const double slips =
          product / (face.limit - face.shear) - product / (face.limit + face.shear);
      (face.along.compliance * face.shear + slips < along ? low : high) = face.shear;
    }
    face.forwards.second = std::max(face.limit - face.shear, rounding * face.limit);
    face.backwards.second = std::max(face.limit + face.shear, rounding * face.limit);
    face.forwards.first = product / face.forwards.second;
    face.backwards.first = product / face.backwards.second;
  }
}

}  // namespace cdca
