// SPDX-License-Identifier: BSD-3-Clause
/// The ranks that a test runs on: one without MPI, all of mpirun's with it.
#pragma once

#include "core/base/communicator.hpp"

namespace cdca::testing {

Communicator& world();
Partitioner world_partitioner();

}  // namespace cdca::testing
