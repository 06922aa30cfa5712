// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/restart.hpp"

#include "core/base/errors.hpp"
#include "io/case_match.hpp"
#include "io/checkpoint_file.hpp"
#include "io/checkpoint_folder.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <system_error>
#include <vector>

namespace cdca {
namespace {

namespace fs = std::filesystem;

/// What the root sees in the folder: other ranks may see it later.
std::vector<fs::path> candidates(const std::string& directory, Communicator& ranks) {
  std::string names;
  if (ranks.is_root()) {
    for (const auto& file : checkpoints_in(directory)) names += file.string() + '\n';
  }
  Bytes bytes;
  pack(bytes, std::span<const char>(names));
  ranks.broadcast(bytes);
  std::vector<fs::path> files;
  std::string name;
  for (const char c : unpack<char>(bytes)) {
    if (c != '\n') {
      name += c;
      continue;
    }
    files.emplace_back(name);
    name.clear();
  }
  return files;
}

void require_file(const std::string& file, Communicator& ranks) {
  std::error_code error;
  if (ranks.max(fs::exists(file, error) ? 1.0 : 0.0) > 0.0) return;
  throw InputError(0, "--restart",
                   fmt::format("There is no file \"{}\"; allowed is a checkpoint.", file));
}

Restart checked(const fs::path& file, StoredCheckpoint stored, const CaseSpec& spec) {
  require_same_case(stored.origin.effective_case, spec.effective, file.string());
  return {file, std::move(stored.checkpoint)};
}

}  // namespace

std::optional<Restart> find_restart(const CommandLine& line, const CaseSpec& spec,
                                    Communicator& ranks) {
  if (!line.restarts) return std::nullopt;
  if (!line.checkpoint.empty()) {
    require_file(line.checkpoint, ranks);
    return checked(line.checkpoint, read_checkpoint(line.checkpoint, ranks), spec);
  }
  const auto files = candidates(line.directory, ranks);
  if (files.empty()) {
    throw InputError(0, "--restart",
                     fmt::format("There is no checkpoint in the folder \"{}\"; allowed is a result "
                                 "folder with one, or the name of a checkpoint.",
                                 line.directory));
  }
  std::string failure;
  for (const auto& file : files) {
    std::optional<StoredCheckpoint> stored;
    try {
      stored = read_checkpoint(file, ranks);
    } catch (const IoError& error) {
      // as all ranks do
      if (ranks.is_root())
        fmt::print(stderr, "cdca: {} The one before is taken, if there is any.\n", error.what());
      if (failure.empty()) failure = error.what();
      continue;
    }
    return checked(file, std::move(*stored), spec);
  }
  throw IoError(failure);
}

}  // namespace cdca
