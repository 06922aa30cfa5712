// SPDX-License-Identifier: BSD-3-Clause
/// How ranks talk. The serial version is complete, so that everything above it runs and is tested
/// without MPI.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cdca {

using Bytes = std::vector<std::byte>;

/// The ranks of a run. All calls but rank() and size() are collective, except exchange(), which
/// involves the named neighbours only.
class Communicator {
 public:
  virtual ~Communicator() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;
  bool is_root() const { return rank() == 0; }

  /// Adds the values of all ranks, entry by entry; every rank receives bitwise the same sums.
  virtual void sum(std::span<double> values) = 0;
  virtual void sum(std::span<std::int64_t> values) = 0;
  virtual void max(std::span<double> values) = 0;
  virtual void min(std::span<double> values) = 0;

  /// The root's bytes, on every rank.
  virtual void broadcast(Bytes& data) = 0;
  /// The bytes of every rank in order of rank, on the root; empty elsewhere.
  virtual std::vector<Bytes> gather(const Bytes& mine) = 0;

  /// Sends `outgoing[k]` to `neighbours[k]` and returns what they sent here, in the same order.
  virtual std::vector<Bytes> exchange(std::span<const int> neighbours,
                                      std::span<const Bytes> outgoing) = 0;
  /// As exchange() for values whose counts both sides know: rank neighbours[k] gets
  /// outgoing[send_offsets[k]..send_offsets[k+1]) and fills incoming[receive_offsets[k]..).
  virtual void exchange_values(std::span<const int> neighbours, std::span<const double> outgoing,
                               std::span<const std::size_t> send_offsets,
                               std::span<double> incoming,
                               std::span<const std::size_t> receive_offsets) = 0;
  virtual void barrier() = 0;

  double sum(double value);
  std::int64_t sum(std::int64_t value);
  double max(double value);
  double min(double value);

  /// Everything discrete is agreed on here: the records of all ranks are gathered, put in order on
  /// one rank, and broadcast, so that all ranks go on from bitwise the same list (method: owner
  /// decides, everyone applies). `Record` must be trivially copyable; `less` must be a strict
  /// order that does not depend on the rank.
  template <class Record, class Less>
  std::vector<Record> agree(const std::vector<Record>& mine, Less less);
};

/// One rank on its own.
class SerialCommunicator final : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void sum(std::span<double>) override {}
  void sum(std::span<std::int64_t>) override {}
  void max(std::span<double>) override {}
  void min(std::span<double>) override {}
  void broadcast(Bytes&) override {}
  std::vector<Bytes> gather(const Bytes& mine) override { return {mine}; }
  std::vector<Bytes> exchange(std::span<const int>, std::span<const Bytes>) override { return {}; }
  void exchange_values(std::span<const int>, std::span<const double>, std::span<const std::size_t>,
                       std::span<double>, std::span<const std::size_t>) override {}
  void barrier() override {}
  using Communicator::max;
  using Communicator::min;
  using Communicator::sum;
};

/// A graph whose vertices are to be shared out: compressed neighbour lists and vertex weights.
struct PartitionGraph {
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> neighbours;
  std::vector<std::int32_t> weights;
};

/// Gives every vertex of a graph a part 0..parts-1. Called on one rank; the answer is broadcast.
using Partitioner = std::function<std::vector<int>(const PartitionGraph& graph, int parts)>;

}  // namespace cdca

#include "core/base/communicator_agree.hpp"
