// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/process_memory.hpp"
#include "drivers/check_command.hpp"
#include "drivers/command_line.hpp"
#include "drivers/failure.hpp"
#include "drivers/launcher.hpp"
#include "drivers/pictures.hpp"
#include "drivers/run_command.hpp"
#include "io/case_manual.hpp"
#include "parallel/mpi_communicator.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace {

using cdca::CommandLine;
using cdca::ExitStatus;

struct Outcome {
  ExitStatus status = ExitStatus::done;
  bool draws_pictures = false;  ///< on this rank
};

void print(const std::string& text, std::FILE* file, const cdca::Communicator& ranks) {
  if (ranks.is_root()) std::fputs(text.c_str(), file);
}

Outcome obey(const CommandLine& line, cdca::Communicator& ranks) {
  Outcome outcome;
  const auto guarded = [&](const std::function<void()>& job) {
    outcome.status = cdca::run_guarded(job, line.case_file, ranks);
  };
  switch (line.command) {
    case CommandLine::Command::run:
      guarded([&] { outcome.draws_pictures = cdca::run_command(line, ranks) && ranks.is_root(); });
      break;
    case CommandLine::Command::check: guarded([&] { cdca::check_command(line, ranks); }); break;
    case CommandLine::Command::options: print(cdca::case_manual(), stdout, ranks); break;
    case CommandLine::Command::help: print(line.text, stdout, ranks); break;
    case CommandLine::Command::mistaken:
      print(fmt::format("cdca: {}\ncdca: See cdca --help.\n", line.text), stderr, ranks);
      outcome.status = ExitStatus::wrong_input;
      break;
  }
  return outcome;
}

}  // namespace

int main(int argc, char** argv) {
  cdca::keep_freed_memory();
  const CommandLine line = cdca::parse_command_line({argv, argv + argc});
  Outcome outcome;
  if (cdca::started_by_launcher()) {
    const cdca::MpiEnvironment environment(argc, argv);
    cdca::MpiCommunicator ranks;
    outcome = obey(line, ranks);
  } else {
    cdca::SerialCommunicator ranks;
    outcome = obey(line, ranks);
  }
  if (outcome.draws_pictures) cdca::draw_pictures(line.directory, line.quiet);
  return static_cast<int>(outcome.status);
}
