// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/communicator.hpp"

#include "tests/world.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace cdca {
namespace {

using testing::world;

struct Record {
  std::int64_t id;
  double value;
};

bool by_id(const Record& a, const Record& b) { return a.id < b.id; }

TEST(CommunicatorTest, PackAndUnpackInvert) {
  Bytes bytes;
  pack(bytes, std::span<const Record>(std::vector<Record>{{7, 0.5}, {-1, 2.0}}));
  pack(bytes, std::span<const Record>(std::vector<Record>{{3, -4.0}}));
  const auto records = unpack<Record>(bytes);
  ASSERT_EQ(records.size(), 3u);
  EXPECT_EQ(records[1].id, -1);
  EXPECT_EQ(records[2].value, -4.0);
  EXPECT_TRUE(unpack<Record>(Bytes{}).empty());
}

TEST(CommunicatorTest, OneRankIsAWorld) {
  SerialCommunicator alone;
  EXPECT_EQ(alone.size(), 1);
  EXPECT_TRUE(alone.is_root());
  EXPECT_EQ(alone.sum(2.5), 2.5);
  EXPECT_EQ(alone.sum(std::int64_t(5)), 5);
  EXPECT_EQ(alone.max(-1.0), -1.0);
  EXPECT_EQ(alone.min(3.0), 3.0);
  EXPECT_EQ(alone.gather(Bytes(3)), std::vector<Bytes>{Bytes(3)});
}

TEST(AgreeParallel, GivesTheSameSortedListOnEveryRank) {
  // rank r holds every number n < 60 with n % ranks == r, the largest first
  const int ranks = world().size();
  std::vector<Record> mine;
  for (int n = 59; n >= 0; --n)
    if (n % ranks == world().rank()) mine.push_back({n, 1.0 / (n + 1)});
  const auto all = world().agree(mine, by_id);
  ASSERT_EQ(all.size(), 60u);  // the same on every rank
  for (std::size_t n = 0; n < 60; ++n) {
    EXPECT_EQ(all[n].id, std::int64_t(n));
    EXPECT_EQ(all[n].value, 1.0 / (double(n) + 1));
  }
}

TEST(AgreeParallel, TakesRanksThatHaveNothingToSay) {
  std::vector<Record> mine;
  if (world().rank() == world().size() - 1) mine = {{9, 1.0}, {4, 2.0}};
  const auto all = world().agree(mine, by_id);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].id, 4);
  EXPECT_EQ(all[1].id, 9);
  EXPECT_TRUE(world().agree(std::vector<int>{}, std::less<>{}).empty());
}

TEST(AgreeParallel, KeepsEqualRecordsInOrderOfRank) {
  const double rank = world().rank();
  const auto all = world().agree(std::vector<Record>{{1, rank}, {1, rank + 0.5}}, by_id);
  ASSERT_EQ(all.size(), 2 * std::size_t(world().size()));
  for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(all[k].value, 0.5 * double(k));
}

}  // namespace
}  // namespace cdca
