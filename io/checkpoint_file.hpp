// SPDX-License-Identifier: BSD-3-Clause
/// Checkpoints as HDF5 files that explain themselves: arrays with names and units, and the case.
#pragma once

#include "core/simulation/checkpoint.hpp"

#include <filesystem>
#include <string>

namespace cdca {

/// What a checkpoint belongs to.
struct CheckpointOrigin {
  std::string version;  ///< of the program
  std::string title;
  std::string effective_case;  ///< the whole input, as a case file
};

/// Replaces the file at once, all ranks together: whoever opens it finds the old one or the new
/// one. Throws IoError on all ranks.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint,
                      const CheckpointOrigin& origin, Communicator& ranks);

struct StoredCheckpoint {
  CheckpointOrigin origin;
  Checkpoint checkpoint;  ///< with an equal share of the cells, whoever owns them
};

/// Reads and checks a file, on any number of ranks. Throws IoError on all of them when it is
/// damaged or no checkpoint of this program. Collective.
StoredCheckpoint read_checkpoint(const std::filesystem::path& file, Communicator& ranks);

}  // namespace cdca
