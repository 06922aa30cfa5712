// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/process_memory.hpp"
#include "parallel/metis_partition.hpp"
#include "parallel/mpi_communicator.hpp"
#include "world.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace {
std::unique_ptr<cdca::MpiCommunicator> communicator;
}

namespace cdca::testing {

Communicator& world() { return *communicator; }
Partitioner world_partitioner() { return metis_partition; }

}  // namespace cdca::testing

int main(int argc, char** argv) {
  cdca::keep_freed_memory();
  const cdca::MpiEnvironment environment(argc, argv);
  ::testing::InitGoogleTest(&argc, argv);
  communicator = std::make_unique<cdca::MpiCommunicator>();
  if (!communicator->is_root()) {
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  // a failure on any rank is one of all ranks
  const std::int64_t failures = communicator->sum(std::int64_t(RUN_ALL_TESTS() != 0));
  communicator.reset();
  return failures == 0 ? 0 : 1;
}
