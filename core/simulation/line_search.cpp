// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/line_search.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

namespace {

/// A move must release this part of the work that its start promises, and stop where the forces
/// have fallen to this part of it.
constexpr double least_released = 1e-3, balanced = 0.1;
/// A move that may go on does so while this part of the forces is left.
constexpr double held = 0.5;

}  // namespace

LineSearch::LineSearch(const Model& model, const std::vector<double>& external,
                       const std::vector<double>& from, const std::vector<double>& anchor)
    : model_(model), move_(model.state()) {
  for (std::size_t k = 0; k < move_.size(); ++k) move_[k] -= from[k];
  const CellStiffness& cells = model.stiffness();
  std::vector<double> product(move_.size(), 0.0);
  cells.apply(from, product);
  for (std::size_t k = 0; k < product.size(); ++k) product[k] = external[k] - product[k];
  cells.add_spring_forces(anchor.empty() ? from : anchor, product);
  driving_ = cells.dot(product, move_);
  cells.apply(move_, product);
  std::vector<double> weak(move_.size(), 0.0);
  if (anchor.empty()) cells.add_spring_forces(move_, weak);
  for (std::size_t k = 0; k < product.size(); ++k) product[k] -= weak[k];
  stiffness_ = cells.dot(product, move_);
  at_ = model.contact_spots().fields(from);
  moves_ = model.contact_spots().fields(move_);
  gaps_ = gaps_of(from);
  gaps_there_ = gaps_of(model.state());
  // the rest of the body, without the faces
  const auto& spots = model.contact_spots();
  driving_ += model.communicator().sum(spots.spring_work(model.contact(), at_, moves_));
  stiffness_ -= model.communicator().sum(spots.spring_work(model.contact(), moves_, moves_));
}

double LineSearch::find(double most) const {
  const double start = work(0.0);
  if (!(start > 0.0)) return 1.0;
  double low = 0.0, high = 1.0, at_low = start, at_high = work(1.0);
  while (2 * high <= most && at_high > held * start) {
    low = high;
    at_low = at_high;
    high *= 2;
    at_high = work(high);
  }
  if (at_high >= 0.0 || released(high) >= least_released * high * start) return high;
  // halving now and then, since the work may jump where faces turn from one slip to the other
  for (int k = 0; k < 100 && high - low > 1e-14 * high; ++k) {
    const double straight = at_low / (at_low - at_high);
    const double share = low + (high - low) * (k % 2 == 0 ? straight : 0.5);
    const double now = work(share);
    if (std::abs(now) <= balanced * start && released(share) >= least_released * share * start)
      return share;
    (now > 0.0 ? low : high) = share;
    (now > 0.0 ? at_low : at_high) = now;
  }
  return high;
}

std::vector<ContactGap> LineSearch::gaps(double share) const {
  std::vector<ContactGap> found;
  for (std::size_t p = 0; p < gaps_.size(); ++p) {
    const auto between = [share](double a, double b) { return a + share * (b - a); };
    found.push_back({between(gaps_[p].normal, gaps_there_[p].normal),
                     between(gaps_[p].tangential, gaps_there_[p].tangential)});
  }
  return found;
}

void LineSearch::go(double share, const std::vector<double>& from,
                    std::vector<double>& state) const {
  if (share == 1.0) return;
  for (std::size_t k = 0; k < from.size(); ++k) state[k] = from[k] + share * move_[k];
}

std::vector<ContactGap> LineSearch::gaps_of(const std::vector<double>& state) const {
  return model_.contact_spots().gaps(state, model_.contact(), model_.communicator());
}

double LineSearch::released(double share) const {
  const auto& spots = model_.contact_spots();
  const auto stored = [&](double s) {
    return spots.stored(model_.contact(), model_.contact().answers_to(gaps(s)), at_, moves_, s);
  };
  return share * (driving_ - 0.5 * share * stiffness_) -
         model_.communicator().sum(stored(share) - stored(0.0));
}

double LineSearch::work(double share) const {
  const auto answers = model_.contact().answers_to(gaps(share));
  return driving_ - share * stiffness_ -
         model_.communicator().sum(
             model_.contact_spots().work(model_.contact(), answers, at_, moves_, share));
}

}  // namespace cdca
