// SPDX-License-Identifier: BSD-3-Clause
/// Ranks that talk through MPI. Only the .cpp beside this file knows mpi.h.
#pragma once

#include "core/base/communicator.hpp"

#include <memory>

namespace cdca {

/// MPI from its start to its end: make one, first thing in main.
class MpiEnvironment {
 public:
  MpiEnvironment(int& argc, char**& argv);
  /// Waits for all ranks. When the stack is being unwound by an exception the other ranks may never
  /// arrive, so the whole run is aborted instead.
  ~MpiEnvironment();
  MpiEnvironment(const MpiEnvironment&) = delete;
  MpiEnvironment& operator=(const MpiEnvironment&) = delete;

  /// Ends all ranks at once: for a failure that the other ranks do not know of.
  [[noreturn]] static void abort(int status);
};

/// All ranks that mpirun started, on a communicator of their own, so that no message is mistaken
/// for one of another library. Messages of 2^31 bytes (exchange_values: values) or more are refused
/// with a SolveError, on every rank that takes part.
class MpiCommunicator final : public Communicator {
 public:
  MpiCommunicator();
  ~MpiCommunicator() override;
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void sum(std::span<double> values) override;
  void sum(std::span<std::int64_t> values) override;
  void max(std::span<double> values) override;
  void min(std::span<double> values) override;
  void broadcast(Bytes& data) override;
  std::vector<Bytes> gather(const Bytes& mine) override;
  /// Neighbours must name each other; a rank may name itself.
  std::vector<Bytes> exchange(std::span<const int> neighbours,
                              std::span<const Bytes> outgoing) override;
  void exchange_values(std::span<const int> neighbours, std::span<const double> outgoing,
                       std::span<const std::size_t> send_offsets, std::span<double> incoming,
                       std::span<const std::size_t> receive_offsets) override;
  void barrier() override;
  using Communicator::max;
  using Communicator::min;
  using Communicator::sum;

 private:
  struct Handle;  // the MPI_Comm

  std::vector<std::int64_t> exchange_sizes(std::span<const int> neighbours,
                                           std::span<const Bytes> outgoing);

  std::unique_ptr<Handle> handle_;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace cdca
