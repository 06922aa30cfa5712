// SPDX-License-Identifier: BSD-3-Clause
/// Limits of friction and the pressures that follow from them are found in turn; this makes the
/// turns few.
#pragma once

#include <vector>

namespace cdca {

/// Anderson's mixing for x = g(x): the next x is the mean of the last g(x) whose residuals g(x) - x
/// cancel best (D. G. Anderson, J. ACM 12, 1965). Same on every rank for the same numbers.
class LimitIteration {
 public:
  /// What to try after `limits` led to `found`.
  std::vector<double> next(const std::vector<double>& limits, const std::vector<double>& found);

 private:
  static constexpr std::size_t depth = 5;  ///< pairs that are kept
  std::vector<std::vector<double>> tried_, found_;
};

}  // namespace cdca
