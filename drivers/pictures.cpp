// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pictures.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace cdca {
namespace {

/// Empty when the script drew the pictures, otherwise why not.
std::string run_script(const std::string& script, std::string directory, bool quiet) {
  // argv wants texts that may be changed.
  std::string program = "/usr/bin/python3";
  std::string file = script;
  std::array<char*, 4> arguments{program.data(), file.data(), directory.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (quiet) posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error =
      posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return fmt::format("{}: {}", program, std::strerror(error));
  int status = 0;
  if (waitpid(child, &status, 0) < 0) return std::strerror(errno);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return WIFEXITED(status) ? fmt::format("{} ended with status {}", script, WEXITSTATUS(status))
                           : fmt::format("{} was killed by signal {}", script, WTERMSIG(status));
}

}  // namespace

void draw_pictures(const std::string& directory, bool quiet) {
  std::fflush(nullptr);
  const auto reason = run_script(CDCA_SOURCE_SCRIPTS "/plot.py", directory, quiet);
  if (!reason.empty()) fmt::print(stderr, "cdca: The pictures were not drawn: {}.\n", reason);
}

}  // namespace cdca
