// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/together.hpp"

#include "core/base/errors.hpp"
#include "tests/world.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace cdca {
namespace {

using testing::world;

/// What together() says on this rank when `work` fails on the ranks for which `fails` is true.
std::string said(bool fails) {
  try {
    together(world(), [&] {
      if (fails) throw std::runtime_error("rank " + std::to_string(world().rank()) + " failed");
    });
  } catch (const IoError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Together, GoesOnWhenAllIsWell) {
  EXPECT_EQ(said(false), "nothing");
  EXPECT_EQ(world().sum(std::int64_t{1}), world().size());
}

TEST(Together, OneFailureReachesEveryRank) {
  const int last = world().size() - 1;
  EXPECT_EQ(said(world().rank() == last), "rank " + std::to_string(last) + " failed");
  EXPECT_EQ(world().sum(std::int64_t{1}), world().size()) << "the ranks are still in step";
}

TEST(Together, TheLowestRankSpeaksForAll) { EXPECT_EQ(said(true), "rank 0 failed"); }

TEST(Together, AnErrorWithoutWordsIsAnErrorStill) {
  EXPECT_THROW(together(world(), [] { throw std::runtime_error(""); }), IoError);
}

}  // namespace
}  // namespace cdca
