// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/condensed_turns.hpp"

#include "core/base/communicator_agree.hpp"
#include "core/mechanics/fixed_point_mixing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace cdca {

namespace {

constexpr double tiny = std::numeric_limits<double>::min();
constexpr int most_turns = 1000;    ///< of one balance
constexpr int most_of_limits = 40;  ///< that limits of friction take in turns with faces
constexpr int most_together = 40;   ///< turns in which limits go along
constexpr int most_no_nearer = 15;  ///< of these: those that come no nearer
constexpr int most_stuck = 5;       ///< turns that lead nowhere
/// More springs that have changed than this part of all are a new reference.
constexpr double few = 0.08;
/// Moves that are no longer downhill may end there: the whole body tells whether it is enough.
constexpr double rounding = 1e-5;
constexpr double exactly = 1e-2;  ///< of what is enough: while turns still come nearer

}  // namespace

CondensedTurns::CondensedTurns(const ContactPatches& patches, const Body& body, const Rule& rule)
    : rule_(rule), body_(body) {
  const auto& places = body.places;
  const auto count = Eigen::Index(places.size());
  lengths_.resize(count), scales_.resize(count), closed_springs_.resize(count);
  std::vector<std::size_t> face_of(patches.patches().size());
  std::vector<char> known(patches.patches().size(), 0);
  for (Eigen::Index k = 0; k < count; ++k) {
    const SpringPlace& place = places[std::size_t(k)];
    lengths_[k] = place.length;
    scales_[k] = 1 + place.compliance * place.stiffness;
    closed_springs_[k] = place.with_body(place.stiffness);
    if (!std::exchange(known[place.patch], 1)) {
      face_of[place.patch] = faces_.size();
      const ContactPatch& patch = patches.patches()[place.patch];
      faces_.push_back({place.patch, patches.law_of(patch)});
      limits_.push_back(patch.limit);
    }
    Face& face = faces_[face_of[place.patch]];
    (place.axis == 1 ? face.across : face.along) = k;
  }
  across_of_.assign(places.size(), -1);
  for (const Face& face : faces_) {
    if (face.along >= 0) across_of_[std::size_t(face.along)] = face.across;
  }
}

double CondensedTurns::limit_at_gap(const Face& face) const {
  return limit_at(face.spec, gaps_[face.across] / scales_[face.across]);
}

std::vector<double> CondensedTurns::limits_here() const {
  std::vector<double> limits;
  for (const Face& face : faces_) limits.push_back(limit_at_gap(face));
  return limits;
}

CondensedTurns::Answers CondensedTurns::answers(Limits limits) const {
  const Eigen::Index count = gaps_.size();
  Answers a;
  a.tractions = a.springs = a.given = a.with_pressure = Eigen::VectorXd::Zero(count);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const bool follow = limits == Limits::follow;
    ContactGap gap{gaps_[face.across] / scales_[face.across], 0.0};
    if (face.along >= 0) gap.tangential = gaps_[face.along] / scales_[face.along];
    const double limit = follow ? limit_at_gap(face) : limits_[f];
    const ContactAnswer answer = contact_answer(face.spec, 0.0, gap, limit);
    a.tractions[face.across] = answer.normal;
    const bool closed = answer.normal_spring > 0.0;
    if (closed) a.springs[face.across] = closed_springs_[face.across];
    if (face.along < 0) continue;
    a.tractions[face.along] = answer.tangential;
    if (answer.tangential_spring > 0.0) {
      a.springs[face.along] = closed_springs_[face.along];
    } else if (follow && closed) {
      const double side = answer.tangential < 0.0 ? -1.0 : 1.0;
      a.with_pressure[face.along] = -side * face.spec.friction * closed_springs_[face.across];
      a.given[face.along] = side * face.spec.cohesion;
    } else {
      a.given[face.along] = answer.tangential;
    }
  }
  return a;
}

double CondensedTurns::softer(const Answers& with, Eigen::Index k) const {
  const double missing = lengths_[k] * (closed_springs_[k] - with.springs[k]);
  const double change = missing - body_.reference.missing()[k];
  return std::abs(change) > 1e-12 * lengths_[k] * closed_springs_[k] ? change : 0.0;
}

Eigen::VectorXd CondensedTurns::tractions_at(const Answers& with,
                                             const Eigen::VectorXd& gaps) const {
  Eigen::VectorXd tractions = with.springs.cwiseProduct(gaps) + with.given;
  for (const Face& face : faces_) {
    if (face.along >= 0)
      tractions[face.along] += with.with_pressure[face.along] * gaps[face.across];
  }
  return tractions;
}

bool CondensedTurns::lay_reference(const Answers& with) {
  ReferenceFaces& reference = body_.reference;
  Eigen::Index turned = 0;
  for (Eigen::Index k = 0; reference.exists() && k < gaps_.size(); ++k)
    turned += softer(with, k) != 0.0;
  if (!reference.exists() || double(turned) > few * double(gaps_.size())) {
    base_.resize(0);
    const Eigen::VectorXd missing =
        lengths_.cwiseProduct(closed_springs_ - with.springs).cwiseMax(0.0);
    if (!reference.refer(body_.compliance, missing)) return false;
  }
  if (base_.size() > 0) return true;
  base_given_ = with.given;
  const Eigen::VectorXd forces = lengths_.cwiseProduct(base_given_);
  base_ = reference.moved(closed_gaps_ - body_.compliance * forces);
  return true;
}

Eigen::VectorXd CondensedTurns::less_at(const Others& others,
                                        const Eigen::Ref<const Eigen::VectorXd>& gaps) const {
  return others.softer.cwiseProduct(gaps(others.places)) -
         others.with_pressure.cwiseProduct(gaps(others.across));
}

CondensedTurns::Others CondensedTurns::others(const Answers& with) const {
  Others others;
  for (Eigen::Index k = 0; k < gaps_.size(); ++k) {
    if (softer(with, k) == 0.0 && with.given[k] == base_given_[k] && with.with_pressure[k] == 0.0)
      continue;
    const Eigen::Index across = across_of_[std::size_t(k)];
    others.places.push_back(k);
    others.across.push_back(across < 0 ? k : across);
  }
  const auto count = Eigen::Index(others.places.size());
  others.softer.resize(count);
  for (Eigen::Index i = 0; i < count; ++i)
    others.softer[i] = softer(with, others.places[std::size_t(i)]);
  others.with_pressure = lengths_(others.places).cwiseProduct(with.with_pressure(others.places));
  others.at = body_.reference.need(body_.compliance, others.places);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(count, count);
  for (Eigen::Index j = 0; j < count; ++j)
    matrix.col(j) -= less_at(others, body_.reference.columns().col(others.at[std::size_t(j)]));
  others.factor.compute(matrix);
  return others;
}

Eigen::VectorXd CondensedTurns::moved(const Others& others, Eigen::VectorXd gaps,
                                      const Eigen::VectorXd& given) const {
  Eigen::VectorXd less = less_at(others, gaps);
  for (Eigen::Index i = 0; i < less.size(); ++i) {
    const Eigen::Index k = others.places[std::size_t(i)];
    less[i] -= lengths_[k] * given[k];
  }
  less = others.factor.solve(less);
  for (Eigen::Index j = 0; j < less.size(); ++j)
    gaps += less[j] * body_.reference.columns().col(others.at[std::size_t(j)]);
  return gaps;
}

bool CondensedTurns::solve(const Answers& with, Eigen::VectorXd& gaps) {
  if (!lay_reference(with)) return false;
  const Others turned = others(with);
  gaps = moved(turned, base_, with.given - base_given_);
  if (refines_) {
    const Eigen::VectorXd less =
        lengths_.cwiseProduct(closed_springs_.cwiseProduct(gaps) - tractions_at(with, gaps));
    const Eigen::VectorXd left = closed_gaps_ - gaps + body_.compliance * less;
    gaps += moved(turned, body_.reference.moved(left), Eigen::VectorXd::Zero(gaps.size()));
  }
  return gaps.allFinite();
}

double CondensedTurns::share_of_move(const Eigen::VectorXd& gaps_there,
                                     const Eigen::VectorXd& tractions_there, Limits limits) {
  constexpr double balanced = 1e-2;
  const Eigen::VectorXd from = gaps_, move = gaps_there - gaps_;
  const Eigen::VectorXd along = lengths_.cwiseProduct(move);
  const double first = along.dot(tractions_), last = along.dot(tractions_there);
  const auto work = [&](double share) {
    gaps_ = from + share * move;
    return first + share * (last - first) - along.dot(answers(limits).tractions);
  };
  const double start = work(0.0);
  double low = 0.0, high = 1.0, at_low = start, at_high = work(1.0);
  double found = 1.0;
  // otherwise rounding is all that is left of the work, and after the move body and faces agree
  // anew
  const bool downhill = start > 0.0;
  for (int k = 0; downhill && at_high < -balanced * start && k < 100; ++k) {
    const double straight = at_low / (at_low - at_high);
    found = low + (high - low) * (k % 2 == 0 ? straight : 0.5);
    const double now = work(found);
    if (std::abs(now) <= balanced * start) break;
    (now > 0.0 ? low : high) = found;
    (now > 0.0 ? at_low : at_high) = now;
  }
  gaps_ = from;
  downhill_ = downhill;
  return found;
}

bool CondensedTurns::turn(const Answers& from, Limits limits) {
  ++turns_;
  Eigen::VectorXd there;
  if (!solve(from, there)) return false;
  const Eigen::VectorXd tractions = tractions_at(from, there);
  const double share = share_of_move(there, tractions, limits);
  gaps_ += share * (there - gaps_);
  tractions_ += share * (tractions - tractions_);
  return true;
}

double CondensedTurns::off_from(const Answers& wanted) const {
  const double largest = wanted.tractions.cwiseAbs().maxCoeff();
  const double off = (wanted.tractions - tractions_).cwiseAbs().maxCoeff();
  return off / std::max({largest, off, tiny});
}

bool CondensedTurns::is_enough(double off, double before) const {
  return off <= exactly * rule_.enough || (off <= rule_.enough && off > 0.5 * before);
}

bool CondensedTurns::settle_at_limits() {
  constexpr double near = 1e-4;
  double before = std::numeric_limits<double>::infinity();
  int stuck = 0;
  base_.resize(0);  // of other limits
  rounded_ = false;
  while (turns_ < most_turns && stuck < most_stuck) {
    const Answers now = answers(Limits::given);
    const double off = off_from(now);
    if (is_enough(off, before)) return true;
    before = off;
    refines_ = off < near || stuck > 0;
    if (!turn(now, Limits::given)) return false;
    stuck += !downhill_;
  }
  rounded_ = stuck == most_stuck && before <= rounding;
  return rounded_;
}

bool CondensedTurns::settle_with_pressures() {
  double best = std::numeric_limits<double>::infinity(), before = best;
  for (int k = 0, no_nearer = 0; k < most_together && no_nearer < most_no_nearer; ++k) {
    const Answers now = answers(Limits::follow);
    const double off = off_from(now);
    if (is_enough(off, before)) return true;
    before = off;
    if (off >= best) ++no_nearer;
    best = std::min(best, off);
    if (!turn(now, Limits::follow) || (!downhill_ && off > rounding)) return false;
  }
  return false;
}

void CondensedTurns::start() {
  if (!rule_.limits_stay) limits_ = limits_here();
  const Eigen::VectorXd from = gaps_;
  tractions_ = answers(Limits::given).tractions;
  const Eigen::VectorXd less = closed_springs_.cwiseProduct(from) - tractions_;
  gaps_ = closed_gaps_ + body_.compliance * lengths_.cwiseProduct(less);
  tractions_ += closed_springs_.cwiseProduct(gaps_ - from);
}

bool CondensedTurns::settle() {
  start();
  if (rule_.limits_stay) return settle_at_limits();
  // there may be several balances with friction: first one where hardly more slips than has to
  const Eigen::VectorXd first_gaps = gaps_, first_tractions = tractions_;
  if (settle_with_pressures()) return true;
  gaps_ = first_gaps;
  tractions_ = first_tractions;
  FixedPointMixing turns(5);
  for (int k = 0; k < most_of_limits && turns_ < most_turns; ++k) {
    if (!settle_at_limits()) return false;
    const Eigen::VectorXd gaps = gaps_, tractions = tractions_;
    const auto found = limits_here();
    if (settle_with_pressures()) return true;
    gaps_ = gaps;
    tractions_ = tractions;
    const double off = off_from(answers(Limits::follow));
    if (off <= rule_.enough || (rounded_ && off <= rounding)) return true;
    limits_ = turns.next(limits_, found);
    for (double& limit : limits_) limit = std::max(0.0, limit);
  }
  return false;
}

CondensedTurns::Found CondensedTurns::find(const std::vector<ContactGap>& from,
                                           Communicator& communicator) {
  const auto by_place = [&](const std::vector<ContactGap>& gaps) {
    Eigen::VectorXd values(scales_.size());
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      const SpringPlace& place = body_.places[std::size_t(k)];
      const ContactGap& gap = gaps[place.patch];
      values[k] = scales_[k] * (place.axis == 1 ? gap.normal : gap.tangential);
    }
    return values;
  };
  struct Outcome {
    int found = 0, turns = 0;
  } outcome;
  Found result{false, 0, body_.closed, {}};
  result.tractions.resize(result.gaps.size());
  if (communicator.is_root()) {
    closed_gaps_ = by_place(body_.closed);
    gaps_ = by_place(from);
    outcome = {settle(), turns_};
    for (const Face& face : faces_) {
      ContactGap& gap = result.gaps[face.patch];
      FaceTraction& traction = result.tractions[face.patch];
      gap.normal = gaps_[face.across] / scales_[face.across];
      traction.normal = tractions_[face.across];
      if (face.along < 0) continue;
      gap.tangential = gaps_[face.along] / scales_[face.along];
      traction.tangential = tractions_[face.along];
    }
  }
  Bytes summary, gaps, tractions;
  if (communicator.is_root()) {
    pack(summary, std::span<const Outcome>(&outcome, 1));
    pack(gaps, std::span<const ContactGap>(result.gaps));
    pack(tractions, std::span<const FaceTraction>(result.tractions));
  }
  communicator.broadcast(summary);
  communicator.broadcast(gaps);
  communicator.broadcast(tractions);
  outcome = unpack<Outcome>(summary).front();
  result.found = outcome.found != 0;
  result.turns = outcome.turns;
  result.gaps = unpack<ContactGap>(gaps);
  result.tractions = unpack<FaceTraction>(tractions);
  return result;
}

}  // namespace cdca
