// SPDX-License-Identifier: BSD-3-Clause
/// Work that may fail on one rank, so that all ranks learn of it and none waits for ever.
#pragma once

#include "core/base/communicator.hpp"

#include <functional>
#include <string>

namespace cdca {

/// The message of the lowest rank that has one; empty when none has. Collective.
std::string first_failure(Communicator& communicator, const std::string& mine);

/// Runs `work` on every rank; when it throws an InputError or a SolveError anywhere, all ranks
/// throw that of the lowest such rank. `work` must not talk to other ranks. Collective.
void fail_together(Communicator& communicator, const std::function<void()>& work);

}  // namespace cdca
