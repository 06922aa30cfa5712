// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/critical_factor.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

namespace {

constexpr double exact = 5e-7;   ///< of the index
constexpr double narrow = 1e-6;  ///< of the factor: the index jumps there
constexpr double held = 0.3;     ///< less than this part of a proportional slope: faces are held
constexpr double up = 0.5, down = 0.125;            ///< the longest steps after the first growth
constexpr double of_last = 10.0, of_first = 100.0;  ///< the highest factor, in those of growth

}  // namespace

CriticalFactor::CriticalFactor(double last, double first)
    : start_(last > 0.0 ? last : 1.0),
      highest_(std::min(of_last * last, of_first * first)),
      virgin_(!(last > 0.0)),
      next_(start_) {}

void CriticalFactor::end(bool grows) {
  ended_ = true;
  grows_ = grows;
}

void CriticalFactor::end_at(double factor, bool grows) {
  next_ = factor;
  last_trial_ = true;
  grows_ = grows;
}

void CriticalFactor::tell(double index) {
  const Trial now{next_, index};
  if (++tried_ == 1) first_ = now;
  if (last_trial_) return end(grows_);
  if (std::abs(index - 1.0) < exact) return end(true);
  if (tried_ == 1 && !(index > 0.0)) return end(false);
  (index < 1.0 ? short_of_ : beyond_) = now;
  if (short_of_ && beyond_) {
    const double width = std::abs(beyond_->factor - short_of_->factor);
    if (width > narrow * now.factor) {
      next_ = between(now);
    } else {
      end_at(beyond_->factor, true);
    }
  } else if (index < 1.0) {
    const bool enough = !virgin_ && now.factor >= highest_;
    enough ? end_at(start_, false) : void(next_ = higher(now));
  } else {
    holds(now) ? end_at(start_, true) : void(next_ = lower(now));
  }
  before_ = now;
}

double CriticalFactor::higher(const Trial& now) const {
  const double slope = (now.index - before_.index) / (now.factor - before_.factor);
  const double step = now.factor - before_.factor;
  const double longest = (virgin_ ? 9 : up) * now.factor;
  if (slope > 0.0) {
    const double most = tried_ == 1 ? longest : std::max(4 * step, 0.02 * now.factor);
    return now.factor + std::min({(1.0 - now.index) / slope, most, longest});
  }
  return now.factor + std::min(std::max(2 * step, 0.02 * now.factor), longest);
}

bool CriticalFactor::holds(const Trial& now) const {
  if (virgin_ || tried_ == 1 || above_proportional(now)) return false;
  const Trial& from = above_proportional(before_) ? first_ : before_;
  return (now.index - from.index) / (now.factor - from.factor) < held * now.index / now.factor;
}

double CriticalFactor::lower(const Trial& now) const {
  const double slope = (now.index - before_.index) / (now.factor - before_.factor);
  double step = slope > 0.0 ? (now.index - 1.0) / slope : now.factor;
  if (above_proportional(now)) step = now.factor - proportional();
  const double longest = virgin_ ? 0.9 * now.factor : std::min(0.9 * now.factor, down * start_);
  return now.factor - std::clamp(step, 1e-9 * now.factor, longest);
}

double CriticalFactor::between(const Trial& now) {
  const Trial &a = *short_of_, &b = *beyond_;
  // secants settle smooth stretches; where they have not got nearer, there may be a jump
  constexpr double nearer = 0.25, close = 0.01;
  constexpr int seldom = 4, in_vain = 3;
  const bool got_nearer = std::abs(now.index - 1.0) < nearer * std::abs(before_.index - 1.0);
  const bool other_side = (now.index < 1.0) != (before_.index < 1.0);
  if (got_nearer) vain_secants_ = 0;
  if (!got_nearer && halvings_ == 0) ++vain_secants_;
  halvings_ = got_nearer || halvings_ >= (vain_secants_ > 1 ? seldom : 1) ? 0 : halvings_ + 1;
  if (other_side) end_holds_ = end_holds_ && on_one_side_ < in_vain;
  on_one_side_ = other_side ? 0 : on_one_side_ + 1;
  double share = halvings_ > 0 ? 0.5 : (1.0 - a.index) / (b.index - a.index);
  // it is often just behind the end that stays, where faces have come to by another way
  if (halvings_ > 0 && end_holds_ && on_one_side_ >= in_vain)
    share = now.index < 1.0 ? 1.0 - close : close;
  return a.factor + std::clamp(share, 1e-3, 1.0 - 1e-3) * (b.factor - a.factor);
}

}  // namespace cdca
