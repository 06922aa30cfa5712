// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/limit_iteration.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cdca {
namespace {

using Limits = std::vector<double>;

/// How a pressure follows from limits: two that push each other, with a fixed point at (1, 2, 3).
Limits follow(const Limits& x) {
  const double a = x[0] - 1, b = x[1] - 2, c = x[2] - 3;
  return {1 + 0.6 * a - 0.3 * b, 2 + 0.3 * a + 0.5 * b, 3 - 0.7 * c};
}

double distance(const Limits& x) { return std::hypot(x[0] - 1, x[1] - 2, x[2] - 3); }

TEST(LimitIteration, FindsTheFixedPointOfALinearMapInOneTurnPerUnknownAndOne) {
  LimitIteration turns;
  Limits x = {0, 0, 0}, plain = x;
  for (int k = 0; k < 5; ++k) {
    x = turns.next(x, follow(x));
    plain = follow(plain);
  }
  EXPECT_LT(distance(x), 1e-9);
  EXPECT_GT(distance(plain), 0.1);  // without mixing
}

TEST(LimitIteration, LimitsStayAboveZero) {
  LimitIteration turns;
  const Limits first = turns.next({1.0, 1.0}, {0.5, 0.9});
  EXPECT_EQ(first, (Limits{0.5, 0.9}));
  for (const double limit : turns.next(first, {0.2, 0.0})) EXPECT_GE(limit, 0.0);
}

}  // namespace
}  // namespace cdca
