// SPDX-License-Identifier: BSD-3-Clause
/// `cdca check`: what the program makes of a case, without running it.
#pragma once

#include "core/base/communicator.hpp"
#include "drivers/command_line.hpp"

namespace cdca {

/// Reads a case, builds its cells and prints what was understood.
/// \throws InputError as read_case() and the simulation do.
void check_command(const CommandLine& line, Communicator& ranks);

}  // namespace cdca
