// SPDX-License-Identifier: BSD-3-Clause
/// `cdca run --restart`: where a run goes on.
#pragma once

#include "core/simulation/checkpoint.hpp"
#include "drivers/command_line.hpp"

#include <filesystem>
#include <optional>

namespace cdca {

struct Restart {
  std::filesystem::path file;
  Checkpoint checkpoint;
};

/// The checkpoint that is named on the command line, or the newest one of the result folder that
/// can be read; none without --restart. Says on standard error when it passes over a damaged one.
/// Throws InputError when there is none, or when it is of another case, IoError when none can be
/// read. Collective.
std::optional<Restart> find_restart(const CommandLine& line, const CaseSpec& spec,
                                    Communicator& ranks);

}  // namespace cdca
