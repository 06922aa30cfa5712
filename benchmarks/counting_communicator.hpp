// SPDX-License-Identifier: BSD-3-Clause
/// Counts what a rank sends to its neighbours.
#pragma once

#include "core/base/communicator.hpp"

namespace cdca::benchmarks {

struct Traffic {
  std::int64_t messages = 0;    ///< sent to neighbours
  std::int64_t bytes = 0;       ///< in them
  std::int64_t reductions = 0;  ///< sums, maxima and broadcasts over all ranks
};

class CountingCommunicator final : public Communicator {
 public:
  explicit CountingCommunicator(Communicator& ranks) : ranks_(ranks) {}
  const Traffic& traffic() const { return traffic_; }
  void restart() { traffic_ = {}; }

  int rank() const override { return ranks_.rank(); }
  int size() const override { return ranks_.size(); }
  void sum(std::span<double> values) override { ranks_.sum(counted(values)); }
  void sum(std::span<std::int64_t> values) override { ranks_.sum(counted(values)); }
  void max(std::span<double> values) override { ranks_.max(counted(values)); }
  void min(std::span<double> values) override { ranks_.min(counted(values)); }
  void broadcast(Bytes& data) override { ranks_.broadcast(counted(data)); }
  std::vector<Bytes> gather(const Bytes& mine) override { return ranks_.gather(counted(mine)); }
  std::vector<Bytes> exchange(std::span<const int> neighbours,
                              std::span<const Bytes> outgoing) override {
    for (const Bytes& message : outgoing) count(message.size());
    return ranks_.exchange(neighbours, outgoing);
  }
  void exchange_values(std::span<const int> neighbours, std::span<const double> outgoing,
                       std::span<const std::size_t> send_offsets, std::span<double> incoming,
                       std::span<const std::size_t> receive_offsets) override {
    for (std::size_t k = 0; k < neighbours.size(); ++k)
      count(sizeof(double) * (send_offsets[k + 1] - send_offsets[k]));
    ranks_.exchange_values(neighbours, outgoing, send_offsets, incoming, receive_offsets);
  }
  void barrier() override { ranks_.barrier(); }
  using Communicator::max;
  using Communicator::min;
  using Communicator::sum;

 private:
  template <class Data>
  Data& counted(Data& data) {
    ++traffic_.reductions;
    return data;
  }
  void count(std::size_t bytes) {
    ++traffic_.messages;
    traffic_.bytes += std::int64_t(bytes);
  }

  Communicator& ranks_;
  Traffic traffic_;
};

}  // namespace cdca::benchmarks
