// SPDX-License-Identifier: BSD-3-Clause
/// What goes wrong on one rank is an error on all.
#include "core/base/first_failure.hpp"

#include "core/base/errors.hpp"
#include "tests/world.hpp"

#include <gtest/gtest.h>

#include <string>

namespace cdca::testing {
namespace {

bool on_last_rank() { return world().rank() == world().size() - 1; }

TEST(FailTogetherParallel, GoesOnWhenAllIsWell) {
  bool done = false;
  fail_together(world(), [&] { done = true; });
  EXPECT_TRUE(done);
}

TEST(FailTogetherParallel, InputErrorsHaveTheirLineAndKeyOnEveryRank) {
  try {
    fail_together(world(), [] {
      if (on_last_rank()) throw InputError(7, "boundary[1].traction", "Found sqrt(-1).");
    });
    FAIL() << "on every rank it throws";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    EXPECT_EQ(error.problems()[0].line, 7);
    EXPECT_EQ(error.problems()[0].key, "boundary[1].traction");
    EXPECT_EQ(error.problems()[0].message, "Found sqrt(-1).");
  }
  EXPECT_EQ(world().sum(std::int64_t{1}), world().size()) << "the ranks are still in step";
}

TEST(FailTogetherParallel, SolveErrorsStaySolveErrors) {
  try {
    fail_together(world(), [] {
      if (on_last_rank()) throw SolveError("no factor");
    });
    FAIL() << "on every rank it throws";
  } catch (const SolveError& error) {
    EXPECT_EQ(std::string(error.what()), "no factor");
  }
  EXPECT_EQ(world().sum(std::int64_t{1}), world().size()) << "the ranks are still in step";
}

}  // namespace
}  // namespace cdca::testing
