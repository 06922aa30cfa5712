// SPDX-License-Identifier: BSD-3-Clause
/// The checkpoints of a result folder.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace cdca {

/// DIRECTORY/checkpoint-STEP.h5.
std::filesystem::path checkpoint_path(const std::filesystem::path& directory, int step);

/// The step in the name of such a file; none for other files.
std::optional<int> checkpoint_step(const std::filesystem::path& file);

/// Those that lie in a folder, the newest (of the latest step) first.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& directory);

/// Removes all but the newest ones, and what broken attempts at writing left. Throws IoError.
void keep_newest_checkpoints(const std::filesystem::path& directory, std::size_t count);

/// Removes those of later steps. Throws IoError.
void remove_checkpoints_after(const std::filesystem::path& directory, int step);

}  // namespace cdca
