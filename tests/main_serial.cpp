// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/process_memory.hpp"
#include "world.hpp"

#include <gtest/gtest.h>

namespace cdca::testing {

Communicator& world() {
  static SerialCommunicator communicator;
  return communicator;
}

Partitioner world_partitioner() {
  return [](const PartitionGraph& graph, int) { return std::vector<int>(graph.weights.size(), 0); };
}

}  // namespace cdca::testing

int main(int argc, char** argv) {
  cdca::keep_freed_memory();
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
