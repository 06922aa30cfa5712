// SPDX-License-Identifier: BSD-3-Clause
/// The search for the load factor at which the next tip grows.
#include "core/simulation/critical_factor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace cdca::testing {
namespace {

struct Found {
  double factor = 0.0;
  int trials = 0;
  bool grows = false;
};

Found found(double last, const std::function<double(double)>& index, double first = 0.0) {
  CriticalFactor search(last, first > 0.0 ? first : last);
  Found result;
  while (!search.ended() && result.trials < 60) {
    result.factor = search.next();
    search.tell(index(result.factor));
    ++result.trials;
  }
  result.grows = search.grows();
  return result;
}

/// And one more for every longest step on the way.
TEST(CriticalFactor, ProportionalIndexTakesTwoTrials) {
  for (const auto& [last, trials] :
       {std::pair{0.0, 2}, std::pair{3.0, 2}, std::pair{4.5, 2}, std::pair{5.0, 3}}) {
    const Found f = found(last, [](double s) { return s / 4; });
    EXPECT_NEAR(f.factor, 4.0, 1e-6);
    EXPECT_EQ(f.trials, trials);
    EXPECT_TRUE(f.grows);
  }
  const Found far = found(0.0, [](double s) { return 1e-7 * s; });
  EXPECT_NEAR(far.factor, 1e7, 10.0);
}

/// The way of friction is followed in steps; all but the last trial but one lie on it.
TEST(CriticalFactor, GoesLongWaysInSteps) {
  for (const double last : {1.0, 40.0}) {
    CriticalFactor search(last, last);
    double before = last;
    int on_the_way = 0;
    while (!search.ended()) {
      const double factor = search.next();
      EXPECT_LE(factor, 1.5 * before * (1 + 1e-12));
      EXPECT_GE(factor, before - 0.125 * last * (1 + 1e-12));
      search.tell(factor / 4);
      on_the_way += search.on_the_way() && !search.ended();
      before = factor;
    }
    EXPECT_NEAR(before, 4.0, 1e-5);
    EXPECT_GE(on_the_way, 4);
  }
  CriticalFactor first(0.0, 0.0);
  first.tell(1e-3);
  EXPECT_FALSE(first.on_the_way()) << "nothing is known to be a way to the first growth";
}

/// Friction holds the faces at first, and the wings close a little; later the faces slide again.
TEST(CriticalFactor, ATipShortOfGrowingWaitsForMoreLoad) {
  const auto index = [](double s) { return std::max(0.99 - 0.05 * (s - 10), 0.1 * (s - 2)); };
  ASSERT_GT(index(9.0), 1.0);  // less load would open it
  const Found f = found(10.0, index);
  EXPECT_TRUE(f.grows);
  EXPECT_NEAR(f.factor, 12.0, 1e-4);
}

TEST(CriticalFactor, SnapsBackWhereFacesSlideBack) {
  const Found f = found(10.0, [](double s) { return s > 8 ? 0.8 + 0.1 * (s - 4) : 0.15 * s; });
  EXPECT_TRUE(f.grows);
  EXPECT_NEAR(f.factor, 20.0 / 3, 1e-5);
}

/// What the first step down does not show, the whole way down does.
TEST(CriticalFactor, SnapsBackPastFacesThatHoldAtFirst) {
  const Found f = found(10.0, [](double s) { return s > 6.5 ? 1.74 + 0.06 * (10 - s) : 0.16 * s; });
  EXPECT_TRUE(f.grows);
  EXPECT_NEAR(f.factor, 6.25, 1e-5);
}

TEST(CriticalFactor, GrowsUnderTheLoadThatIsThereWhereFrictionHolds) {
  for (const double slope : {0.0, 0.02, -0.03}) {
    const Found f = found(10.0, [=](double s) { return 1.3 + slope * (s - 10); });
    EXPECT_TRUE(f.grows);
    EXPECT_EQ(f.factor, 10.0);
    EXPECT_LE(f.trials, 4);  // two steps down, and the end
  }
}

TEST(CriticalFactor, EndsAboveAJump) {
  const Found f = found(5.0, [](double s) { return s < 7.3 ? 0.9 : 1.2; });
  EXPECT_TRUE(f.grows);
  EXPECT_GE(f.factor, 7.3);
  EXPECT_LT(f.factor, 7.3 + 2e-5);
}

TEST(CriticalFactor, GivesUpWhereNothingOpensATip) {
  EXPECT_FALSE(found(0.0, [](double) { return 0.0; }).grows);
  const Found f = found(3.0, [](double s) { return 1 / (1 + s); });
  EXPECT_FALSE(f.grows);
  EXPECT_EQ(f.factor, 3.0);
}

TEST(CriticalFactor, GivesUpAtAHundredTimesTheFirst) {
  const auto index = [](double s) { return s < 500 ? 0.5 : 1.5; };
  EXPECT_TRUE(found(60.0, index, 6.0).grows);
  EXPECT_FALSE(found(60.0, index, 4.0).grows);
}

/// One side is far beyond: secants alone would creep up to the jump from the other.
TEST(CriticalFactor, FindsAJumpBetweenUnequalSides) {
  for (const double beyond : {1.001, 7.5, 1e4}) {
    const Found f = found(5.0, [=](double s) { return s < 17.3 ? 0.88 : beyond; });
    EXPECT_TRUE(f.grows);
    EXPECT_GE(f.factor, 17.3);
    EXPECT_LT(f.factor, 17.3 + 5e-5);
    EXPECT_LE(f.trials, 50) << beyond;
  }
}

/// Faces come to other places by other ways: the jump is where the search has been before.
TEST(CriticalFactor, SoonFindsAJumpAtATrial) {
  const Found f = found(15.0, [](double s) { return s <= 15.0 ? 0.99 : s / 14.9; });
  EXPECT_TRUE(f.grows);
  EXPECT_LT(f.factor, 15.0 * (1 + 2e-6));
  EXPECT_LE(f.trials, 14) << "halving alone takes more";
}

}  // namespace
}  // namespace cdca::testing
