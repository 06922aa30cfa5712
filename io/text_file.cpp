// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_file.hpp"

#include "core/base/errors.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

namespace cdca {
namespace {

void put(const std::filesystem::path& file, std::string_view text, std::ios::openmode mode) {
  errno = 0;
  std::ofstream out(file, mode | std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out)
    throw IoError("Cannot write " + file.string() + ": " +
                  (errno != 0 ? std::strerror(errno) : "unknown reason") + ".");
}

}  // namespace

void write_text(const std::filesystem::path& file, std::string_view text) {
  auto draft = file;
  draft += ".tmp";
  std::error_code error;
  try {
    put(draft, text, std::ios::trunc);
  } catch (const IoError&) {
    std::filesystem::remove(draft, error);
    throw;
  }
  std::filesystem::rename(draft, file, error);
  if (error) throw IoError("Cannot write " + file.string() + ": " + error.message() + ".");
}

void append_text(const std::filesystem::path& file, std::string_view text) {
  put(file, text, std::ios::app);
}

void remove_old(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::remove(file, error);
  if (error) throw IoError("Cannot remove the old " + file.string() + ": " + error.message() + ".");
}

}  // namespace cdca
