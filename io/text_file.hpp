// SPDX-License-Identifier: BSD-3-Clause
/// Small text files, written so that a reader never meets half of one.
#pragma once

#include <filesystem>
#include <string_view>

namespace cdca {

/// Replaces the file at once: whoever opens it finds the old text or the new one. Throws IoError.
void write_text(const std::filesystem::path& file, std::string_view text);

/// Adds text at the end of a file, which is created when it is missing. Throws IoError.
void append_text(const std::filesystem::path& file, std::string_view text);

/// Removes a file that may be there. Throws IoError.
void remove_old(const std::filesystem::path& file);

}  // namespace cdca
