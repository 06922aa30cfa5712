// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/mpi_communicator.hpp"

#include "core/base/errors.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <numeric>
#include <string>

namespace cdca {
namespace {

constexpr int root = 0;
constexpr int size_tag = 1;
constexpr int bytes_tag = 2;
constexpr int values_tag = 3;
constexpr std::int64_t largest_message = std::numeric_limits<int>::max();

int checked_count(std::int64_t count) {
  if (count > largest_message)
    throw SolveError("A message between ranks has " + std::to_string(count) + " entries; at most " +
                     std::to_string(largest_message) + " are possible. Use more ranks.");
  return static_cast<int>(count);
}

MPI_Datatype type_of(const double*) { return MPI_DOUBLE; }
MPI_Datatype type_of(const std::int64_t*) { return MPI_INT64_T; }

/// Reduces on the root and hands its result out: an allreduce may add in another order on each
/// rank.
template <class T>
void reduce(std::span<T> values, MPI_Op operation, MPI_Comm comm, bool is_root) {
  const int count = checked_count(static_cast<std::int64_t>(values.size()));
  if (count == 0) return;
  const MPI_Datatype type = type_of(values.data());
  MPI_Reduce(is_root ? MPI_IN_PLACE : values.data(), values.data(), count, type, operation, root,
             comm);
  MPI_Bcast(values.data(), count, type, root, comm);
}

/// Receives and sends under way. Receives are added first, so that status k belongs to receive k.
class Requests {
 public:
  void receive(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm) {
    MPI_Irecv(data, count, type, from, tag, comm, &requests_.emplace_back(MPI_REQUEST_NULL));
    expected_.push_back(count);
    types_.push_back(type);
  }
  void send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
    MPI_Isend(data, count, type, to, tag, comm, &requests_.emplace_back(MPI_REQUEST_NULL));
  }
  void wait() {
    std::vector<MPI_Status> statuses(requests_.size());
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), statuses.data());
    for (std::size_t k = 0; k < expected_.size(); ++k) {
      int count = 0;
      MPI_Get_count(&statuses[k], types_[k], &count);
      if (count != expected_[k])
        throw SolveError("Rank " + std::to_string(statuses[k].MPI_SOURCE) + " sent " +
                         std::to_string(count) + " values where " + std::to_string(expected_[k]) +
                         " were expected.");
    }
  }

 private:
  std::vector<MPI_Request> requests_;
  std::vector<int> expected_;
  std::vector<MPI_Datatype> types_;
};

}  // namespace

MpiEnvironment::MpiEnvironment(int& argc, char**& argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
}

MpiEnvironment::~MpiEnvironment() {
  if (std::uncaught_exceptions() > 0) {
    std::fputs("An error on one rank ends the run on all ranks.\n", stderr);
    abort(1);
  }
  MPI_Finalize();
}

void MpiEnvironment::abort(int status) {
  std::fflush(nullptr);
  MPI_Abort(MPI_COMM_WORLD, status);
  std::abort();  // MPI_Abort does not return, but is not declared so
}

struct MpiCommunicator::Handle {
  MPI_Comm comm = MPI_COMM_NULL;
};

MpiCommunicator::MpiCommunicator() : handle_(std::make_unique<Handle>()) {
  MPI_Comm_dup(MPI_COMM_WORLD, &handle_->comm);
  MPI_Comm_rank(handle_->comm, &rank_);
  MPI_Comm_size(handle_->comm, &size_);
}

MpiCommunicator::~MpiCommunicator() {
  // Freeing is collective; while an exception unwinds, the others may not come.
  if (std::uncaught_exceptions() == 0) MPI_Comm_free(&handle_->comm);
}

void MpiCommunicator::sum(std::span<double> values) {
  reduce(values, MPI_SUM, handle_->comm, is_root());
}

void MpiCommunicator::sum(std::span<std::int64_t> values) {
  reduce(values, MPI_SUM, handle_->comm, is_root());
}

void MpiCommunicator::max(std::span<double> values) {
  reduce(values, MPI_MAX, handle_->comm, is_root());
}

void MpiCommunicator::min(std::span<double> values) {
  reduce(values, MPI_MIN, handle_->comm, is_root());
}

void MpiCommunicator::broadcast(Bytes& data) {
  auto length = static_cast<std::int64_t>(data.size());
  MPI_Bcast(&length, 1, MPI_INT64_T, root, handle_->comm);
  const int count = checked_count(length);
  data.resize(static_cast<std::size_t>(length));
  MPI_Bcast(data.data(), count, MPI_BYTE, root, handle_->comm);
}

std::vector<Bytes> MpiCommunicator::gather(const Bytes& mine) {
  const auto ranks = static_cast<std::size_t>(size_);
  // Every rank learns all lengths, so that all refuse a message that is too long.
  const auto length = static_cast<std::int64_t>(mine.size());
  std::vector<std::int64_t> lengths(ranks);
  MPI_Allgather(&length, 1, MPI_INT64_T, lengths.data(), 1, MPI_INT64_T, handle_->comm);
  checked_count(std::reduce(lengths.begin(), lengths.end()));

  const std::vector<int> counts(lengths.begin(), lengths.end());
  std::vector<int> starts(ranks, 0);
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  Bytes all(is_root() ? static_cast<std::size_t>(starts.back() + counts.back()) : 0);
  MPI_Gatherv(mine.data(), static_cast<int>(length), MPI_BYTE, all.data(), counts.data(),
              starts.data(), MPI_BYTE, root, handle_->comm);
  std::vector<Bytes> parts;
  if (!is_root()) return parts;
  for (std::size_t r = 0; r < ranks; ++r)
    parts.emplace_back(all.begin() + starts[r], all.begin() + starts[r] + counts[r]);
  return parts;
}

std::vector<std::int64_t> MpiCommunicator::exchange_sizes(std::span<const int> neighbours,
                                                          std::span<const Bytes> outgoing) {
  std::vector<std::int64_t> there(neighbours.size());
  std::vector<std::int64_t> here(neighbours.size());
  Requests requests;
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    requests.receive(&there[k], 1, MPI_INT64_T, neighbours[k], size_tag, handle_->comm);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    here[k] = static_cast<std::int64_t>(outgoing[k].size());
    requests.send(&here[k], 1, MPI_INT64_T, neighbours[k], size_tag, handle_->comm);
  }
  requests.wait();
  // Both sides of a message that is too long refuse it, and before any byte is sent.
  for (const std::int64_t size : here) checked_count(size);
  for (const std::int64_t size : there) checked_count(size);
  return there;
}

std::vector<Bytes> MpiCommunicator::exchange(std::span<const int> neighbours,
                                             std::span<const Bytes> outgoing) {
  if (neighbours.size() != outgoing.size())
    throw SolveError("exchange: there must be one message for every neighbour.");
  const auto sizes = exchange_sizes(neighbours, outgoing);
  std::vector<Bytes> incoming(neighbours.size());
  Requests requests;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    incoming[k].resize(static_cast<std::size_t>(sizes[k]));
    if (!incoming[k].empty())
      requests.receive(incoming[k].data(), static_cast<int>(sizes[k]), MPI_BYTE, neighbours[k],
                       bytes_tag, handle_->comm);
  }
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    if (!outgoing[k].empty())
      requests.send(outgoing[k].data(), static_cast<int>(outgoing[k].size()), MPI_BYTE,
                    neighbours[k], bytes_tag, handle_->comm);
  requests.wait();
  return incoming;
}

void MpiCommunicator::exchange_values(std::span<const int> neighbours,
                                      std::span<const double> outgoing,
                                      std::span<const std::size_t> send_offsets,
                                      std::span<double> incoming,
                                      std::span<const std::size_t> receive_offsets) {
  if (neighbours.empty()) return;
  if (send_offsets.size() != neighbours.size() + 1 ||
      receive_offsets.size() != neighbours.size() + 1 || send_offsets.back() > outgoing.size() ||
      receive_offsets.back() > incoming.size())
    throw SolveError("exchange_values: the offsets do not fit the neighbours or the values.");
  const auto count = [](std::span<const std::size_t> offsets, std::size_t k) {
    return checked_count(static_cast<std::int64_t>(offsets[k + 1] - offsets[k]));
  };
  Requests requests;
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    requests.receive(incoming.data() + receive_offsets[k], count(receive_offsets, k), MPI_DOUBLE,
                     neighbours[k], values_tag, handle_->comm);
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    requests.send(outgoing.data() + send_offsets[k], count(send_offsets, k), MPI_DOUBLE,
                  neighbours[k], values_tag, handle_->comm);
  requests.wait();
}

void MpiCommunicator::barrier() { MPI_Barrier(handle_->comm); }

}  // namespace cdca
