// SPDX-License-Identifier: BSD-3-Clause
/// `cdca run`: the main job.
#pragma once

#include "core/base/communicator.hpp"
#include "drivers/command_line.hpp"

namespace cdca {

/// Runs a case, on all ranks together. Returns whether pictures are wanted of the results.
/// \throws InputError, SolveError, IoError.
bool run_command(const CommandLine& line, Communicator& ranks);

}  // namespace cdca
