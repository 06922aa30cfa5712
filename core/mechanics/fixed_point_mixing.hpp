// SPDX-License-Identifier: BSD-3-Clause
/// Values that must agree with what follows from them are found in turns; this makes them few.
#pragma once

#include <cstddef>
#include <vector>

namespace cdca {

/// Anderson's mixing for x = g(x): the next x is the mean of the last g(x) whose residuals g(x) - x
/// cancel best (D. G. Anderson, J. ACM 12, 1965). Same on every rank for the same numbers.
class FixedPointMixing {
 public:
  /// depth: pairs of x and g(x) that are kept.
  explicit FixedPointMixing(std::size_t depth) : depth_(depth) {}
  /// What to try after `tried` led to `found`.
  std::vector<double> next(const std::vector<double>& tried, const std::vector<double>& found);

 private:
  std::size_t depth_;
  std::vector<std::vector<double>> tried_, found_;
};

}  // namespace cdca
