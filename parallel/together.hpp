// SPDX-License-Identifier: BSD-3-Clause
/// Work that may fail on one rank, so that all ranks learn of it and none waits for ever.
#pragma once

#include "core/base/communicator.hpp"

#include <functional>

namespace cdca {

/// Runs `work` on every rank, then compares notes: when it threw anywhere, all ranks throw an
/// IoError with the message of the lowest rank that failed. `work` must not talk to other ranks.
void together(Communicator& comm, const std::function<void()>& work);

}  // namespace cdca
