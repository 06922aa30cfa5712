// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/fixed_point_mixing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cdca {
namespace {

using Values = std::vector<double>;

/// Two values that push each other and one by itself, with a fixed point at (1, 2, 3).
Values follow(const Values& x) {
  const double a = x[0] - 1, b = x[1] - 2, c = x[2] - 3;
  return {1 + 0.6 * a - 0.3 * b, 2 + 0.3 * a + 0.5 * b, 3 - 0.7 * c};
}

double distance(const Values& x) { return std::hypot(x[0] - 1, x[1] - 2, x[2] - 3); }

TEST(FixedPointMixing, FindsTheFixedPointOfALinearMapInOneTurnPerUnknownAndOne) {
  FixedPointMixing turns(5);
  Values x = {0, 0, 0}, plain = x;
  for (int k = 0; k < 5; ++k) {
    x = turns.next(x, follow(x));
    plain = follow(plain);
  }
  EXPECT_LT(distance(x), 1e-9);
  EXPECT_GT(distance(plain), 0.1);  // without mixing
}

TEST(FixedPointMixing, StartsWithWhatWasFound) {
  FixedPointMixing turns(5);
  EXPECT_EQ(turns.next({1.0, 1.0}, {0.5, 0.9}), (Values{0.5, 0.9}));
}

}  // namespace
}  // namespace cdca
