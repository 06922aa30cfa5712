// SPDX-License-Identifier: BSD-3-Clause
/// What the user typed.
#pragma once

#include <string>
#include <vector>

namespace cdca {

struct CommandLine {
  enum class Command {
    run,
    check,
    options,   ///< print the manual page of the case file
    help,      ///< print `text`: the help or the version
    mistaken,  ///< print `text`: what is wrong with the command line
  };
  Command command = Command::help;
  std::string case_file;
  std::string directory;              ///< of the results
  std::vector<std::string> settings;  ///< "key.path=value", in order
  bool quiet = false;
  bool restarts = false;   ///< goes on from a checkpoint
  std::string checkpoint;  ///< from this one; empty: the newest one of the result folder
  std::string text;
};

/// Never throws; a command line that cannot be understood is `mistaken`. The arguments are those of
/// main, the program's name included.
CommandLine parse_command_line(const std::vector<std::string>& arguments);

}  // namespace cdca
