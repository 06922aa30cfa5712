// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/mpi_communicator.hpp"

#include "tests/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace cdca {
namespace {

using testing::world;

Bytes bytes_of(const std::string& text) {
  Bytes bytes;
  pack(bytes, std::span<const char>(text));
  return bytes;
}

std::string text_of(const Bytes& bytes) {
  const auto letters = unpack<char>(bytes);
  return {letters.begin(), letters.end()};
}

/// True when the bytes of `mine` are the same on every rank.
template <class T>
bool same_everywhere(const std::vector<T>& mine) {
  Bytes bytes;
  pack(bytes, std::span<const T>(mine));
  Bytes of_root = bytes;
  world().broadcast(of_root);
  return world().min(of_root == bytes ? 1.0 : 0.0) == 1.0;
}

/// All ranks but this one.
std::vector<int> all_others() {
  std::vector<int> others;
  for (int r = 0; r < world().size(); ++r)
    if (r != world().rank()) others.push_back(r);
  return others;
}

TEST(MpiCommunicator, KnowsItsPlace) {
  EXPECT_GE(world().rank(), 0);
  EXPECT_LT(world().rank(), world().size());
  EXPECT_EQ(world().is_root(), world().rank() == 0);
  // Each rank counts itself once: the places are all different exactly when this sum comes out.
  std::vector<std::int64_t> seen(static_cast<std::size_t>(world().size()), 0);
  seen[static_cast<std::size_t>(world().rank())] = 1;
  world().sum(std::span<std::int64_t>(seen));
  EXPECT_EQ(seen, std::vector<std::int64_t>(seen.size(), 1));
}

TEST(MpiCommunicator, AddsEntryByEntry) {
  const double rank = world().rank();
  const double ranks = world().size();
  std::vector<double> values{rank, 1.0, -2.0 * rank};
  world().sum(std::span<double>(values));
  const double total = ranks * (ranks - 1.0) / 2.0;
  EXPECT_EQ(values, (std::vector<double>{total, ranks, -2.0 * total}));
  EXPECT_EQ(world().sum(0.5), 0.5 * ranks);
}

TEST(MpiCommunicator, AddsWholeNumbersBeyondDoubles) {
  const std::int64_t large = (std::int64_t{1} << 60) + 1;
  EXPECT_EQ(world().sum(world().is_root() ? large : std::int64_t{2}),
            large + 2 * (world().size() - 1));
}

TEST(MpiCommunicator, SumsAreBitwiseTheSameOnAllRanks) {
  std::vector<double> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = std::sin(static_cast<double>(i * 7 + 1) * (world().rank() + 1.3)) *
                std::pow(10.0, static_cast<double>(i % 17) - 8.0);
  world().sum(std::span<double>(values));
  EXPECT_TRUE(same_everywhere(values));
}

TEST(MpiCommunicator, FindsLargestAndSmallest) {
  const double rank = world().rank();
  const double last = world().size() - 1;
  std::vector<double> values{rank, -rank};
  world().max(std::span<double>(values));
  EXPECT_EQ(values, (std::vector<double>{last, 0.0}));
  values = {rank, -rank};
  world().min(std::span<double>(values));
  EXPECT_EQ(values, (std::vector<double>{0.0, -last}));
  EXPECT_EQ(world().max(rank), last);
  EXPECT_EQ(world().min(-rank), -last);
}

TEST(MpiCommunicator, ReducesNothingAtAll) {
  std::vector<double> none;
  world().sum(std::span<double>(none));
  world().max(std::span<double>(none));
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(world().sum(std::int64_t{1}), world().size());  // still in step afterwards
}

TEST(MpiCommunicator, BroadcastsTheBytesOfTheRoot) {
  Bytes data = bytes_of(world().is_root() ? "from the root" : std::string(50, 'x'));
  world().broadcast(data);
  EXPECT_EQ(text_of(data), "from the root");
  data = world().is_root() ? Bytes{} : bytes_of("leftover");
  world().broadcast(data);
  EXPECT_TRUE(data.empty());
}

TEST(MpiCommunicator, GathersInOrderOfRank) {
  const int rank = world().rank();
  // Odd ranks have nothing to say.
  const auto parts = world().gather(
      rank % 2 == 1 ? Bytes{} : bytes_of(std::string(3, static_cast<char>('a' + rank))));
  if (!world().is_root()) {
    EXPECT_TRUE(parts.empty());
    return;
  }
  ASSERT_EQ(parts.size(), static_cast<std::size_t>(world().size()));
  for (int r = 0; r < world().size(); ++r)
    EXPECT_EQ(text_of(parts[static_cast<std::size_t>(r)]),
              r % 2 == 1 ? "" : std::string(3, static_cast<char>('a' + r)));
}

TEST(MpiCommunicator, GathersNothingFromAnyone) {
  const auto parts = world().gather({});
  EXPECT_EQ(parts.size(), world().is_root() ? static_cast<std::size_t>(world().size()) : 0u);
  for (const Bytes& part : parts) EXPECT_TRUE(part.empty());
}

TEST(MpiCommunicator, ExchangesWithAllOthers) {
  const auto others = all_others();
  std::vector<Bytes> outgoing;
  for (const int other : others)
    outgoing.push_back(bytes_of(std::to_string(world().rank()) + ">" + std::to_string(other)));
  for (int repeat = 0; repeat < 3; ++repeat) {
    const auto incoming = world().exchange(others, outgoing);
    ASSERT_EQ(incoming.size(), others.size());
    for (std::size_t k = 0; k < others.size(); ++k)
      EXPECT_EQ(text_of(incoming[k]),
                std::to_string(others[k]) + ">" + std::to_string(world().rank()));
  }
}

TEST(MpiCommunicator, ExchangesMessagesOfVeryDifferentSize) {
  const auto others = all_others();
  const auto length = [](int from, int to) {
    return from > to ? std::size_t{0} : static_cast<std::size_t>(200000 * (from + 1) + to);
  };
  std::vector<Bytes> outgoing;
  for (const int other : others)
    outgoing.push_back(bytes_of(std::string(length(world().rank(), other), 'm')));
  const auto incoming = world().exchange(others, outgoing);
  for (std::size_t k = 0; k < others.size(); ++k)
    EXPECT_EQ(text_of(incoming[k]), std::string(length(others[k], world().rank()), 'm'));
}

TEST(MpiCommunicator, ExchangesAlongAChain) {
  // Rank r knows r-1 and r+1 only; the ends of the chain have one neighbour, a single rank none.
  std::vector<int> neighbours;
  if (world().rank() > 0) neighbours.push_back(world().rank() - 1);
  if (world().rank() + 1 < world().size()) neighbours.push_back(world().rank() + 1);
  const std::vector<Bytes> outgoing(neighbours.size(), bytes_of(std::to_string(world().rank())));
  const auto incoming = world().exchange(neighbours, outgoing);
  ASSERT_EQ(incoming.size(), neighbours.size());
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    EXPECT_EQ(text_of(incoming[k]), std::to_string(neighbours[k]));
}

TEST(MpiCommunicator, LeavesOutRanksWithoutNeighbours) {
  // The last rank takes no part; the others must not wait for it.
  const int last = world().size() - 1;
  std::vector<int> neighbours = all_others();
  std::erase(neighbours, last);
  if (world().rank() == last) neighbours.clear();
  const std::vector<Bytes> outgoing(neighbours.size(), bytes_of("hello"));
  const auto incoming = world().exchange(neighbours, outgoing);
  ASSERT_EQ(incoming.size(), neighbours.size());
  for (const Bytes& message : incoming) EXPECT_EQ(text_of(message), "hello");
}

TEST(MpiCommunicator, ExchangesValuesOfKnownCounts) {
  // From rank a to rank b go a + 2 b values; so rank 0 sends nothing to itself and little to
  // others.
  const auto others = all_others();
  const int rank = world().rank();
  std::vector<double> outgoing;
  std::vector<std::size_t> sends{0};
  std::vector<std::size_t> receives{0};
  for (const int other : others) {
    for (int i = 0; i < rank + 2 * other; ++i) outgoing.push_back(100.0 * rank + 10.0 * other + i);
    sends.push_back(outgoing.size());
    receives.push_back(receives.back() + static_cast<std::size_t>(other + 2 * rank));
  }
  std::vector<double> incoming(receives.back(), -1.0);
  world().exchange_values(others, outgoing, sends, incoming, receives);
  for (std::size_t k = 0; k < others.size(); ++k)
    for (std::size_t i = receives[k]; i < receives[k + 1]; ++i)
      EXPECT_EQ(incoming[i],
                100.0 * others[k] + 10.0 * rank + static_cast<double>(i - receives[k]));
}

TEST(MpiCommunicator, ExchangesNoValues) {
  const auto others = all_others();
  const std::vector<std::size_t> offsets(others.size() + 1, 0);
  world().exchange_values(others, {}, offsets, {}, offsets);
  world().exchange_values({}, {}, {}, {}, {});
  EXPECT_EQ(world().sum(std::int64_t{1}), world().size());
}

struct Record {
  int rank;
  int id;
  double value;
};

TEST(MpiCommunicator, AgreesOnOneOrderedListEverywhere) {
  // Rank r brings r records, so the root brings none; ids interleave between the ranks.
  std::vector<Record> mine;
  for (int i = 0; i < world().rank(); ++i)
    mine.push_back({world().rank(), 100 - i * world().size() - world().rank(), std::sqrt(2.0 + i)});
  const auto agreed =
      world().agree(mine, [](const Record& a, const Record& b) { return a.id < b.id; });
  EXPECT_EQ(agreed.size(), static_cast<std::size_t>(world().size() * (world().size() - 1) / 2));
  EXPECT_TRUE(std::is_sorted(agreed.begin(), agreed.end(),
                             [](const Record& a, const Record& b) { return a.id < b.id; }));
  for (const Record& record : agreed)
    EXPECT_EQ(record.id % world().size(), (100 - record.rank) % world().size());
  EXPECT_TRUE(same_everywhere(agreed));
}

TEST(MpiCommunicator, AgreesOnNothing) {
  EXPECT_TRUE(world().agree(std::vector<int>{}, std::less<>{}).empty());
}

TEST(MpiCommunicator, AgreesWithEqualRecordsInOrderOfRank) {
  const std::vector<Record> mine{{world().rank(), 5, 0.0}};
  const auto agreed =
      world().agree(mine, [](const Record& a, const Record& b) { return a.id < b.id; });
  ASSERT_EQ(agreed.size(), static_cast<std::size_t>(world().size()));
  for (int r = 0; r < world().size(); ++r) EXPECT_EQ(agreed[static_cast<std::size_t>(r)].rank, r);
}

TEST(MpiCommunicator, KeepsItsMessagesFromThoseOfAnotherCommunicator) {
  // Started on all ranks; used in turn with the world, so that mixed-up messages would show.
  MpiCommunicator other;
  ASSERT_EQ(other.size(), world().size());
  const auto others = all_others();
  const std::vector<Bytes> first(others.size(), bytes_of("first"));
  const std::vector<Bytes> second(others.size(), bytes_of("second"));
  const auto from_other = other.exchange(others, first);
  const auto from_world = world().exchange(others, second);
  for (const Bytes& message : from_other) EXPECT_EQ(text_of(message), "first");
  for (const Bytes& message : from_world) EXPECT_EQ(text_of(message), "second");
  other.barrier();
}

}  // namespace
}  // namespace cdca
