// SPDX-License-Identifier: BSD-3-Clause
#include "io/checkpoint_folder.hpp"

#include "io/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>

namespace cdca {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = "checkpoint-", suffix = ".h5", draft_suffix = ".h5.tmp";

/// The number between the prefix and an ending.
std::optional<int> number_in(const std::string& name, std::string_view ending) {
  if (!name.starts_with(prefix) || !name.ends_with(ending)) return std::nullopt;
  const char* first = name.data() + prefix.size();
  const char* last = name.data() + name.size() - ending.size();
  int number = 0;
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc() || end != last || first == last || number < 0) return std::nullopt;
  return number;
}

}  // namespace

fs::path checkpoint_path(const fs::path& directory, int step) {
  return directory / fmt::format("{}{}{}", prefix, step, suffix);
}

std::optional<int> checkpoint_step(const fs::path& file) {
  return number_in(file.filename().string(), suffix);
}

std::vector<fs::path> checkpoints_in(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error))
    if (checkpoint_step(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return checkpoint_step(a) > checkpoint_step(b);
  });
  return files;
}

void keep_newest_checkpoints(const fs::path& directory, std::size_t count) {
  const auto files = checkpoints_in(directory);
  for (std::size_t k = count; k < files.size(); ++k) remove_old(files[k]);
  std::vector<fs::path> drafts;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error))
    if (number_in(entry.path().filename().string(), draft_suffix)) drafts.push_back(entry.path());
  std::for_each(drafts.begin(), drafts.end(), remove_old);
}

void remove_checkpoints_after(const fs::path& directory, int step) {
  for (const auto& file : checkpoints_in(directory))
    if (checkpoint_step(file) > step) remove_old(file);
}

}  // namespace cdca
