// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/command_line.hpp"

#include "cdca_version.hpp"
#include "io/case_options.hpp"
#include "io/spelling.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace cdca {
namespace {

constexpr const char* epilogue =
    "Exit status: 0 done; 2 the input is wrong; 3 the solve did not converge or an invariant "
    "broke;\n"
    "4 a file could not be read or written.";

/// "--set a=1 b=2" means the same as "--set a=1 --set b=2".
std::vector<std::string> with_repeated_set(const std::vector<std::string>& arguments) {
  std::vector<std::string> out;
  bool after_setting = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const auto& argument = arguments[i];
    const bool is_flag = argument.starts_with("-");
    if (after_setting && !is_flag && argument.find('=') != std::string::npos)
      out.emplace_back("--set");
    out.push_back(argument);
    after_setting = (i > 0 && arguments[i - 1] == "--set") || argument.starts_with("--set=") ||
                    (after_setting && !is_flag);
  }
  return out;
}

/// "--restart FILE.h5" means the same as "--restart=FILE.h5"; what does not look like a checkpoint
/// is an argument of its own.
std::vector<std::string> with_joined_restart(const std::vector<std::string>& arguments) {
  std::vector<std::string> out;
  for (const auto& argument : arguments) {
    const bool is_file = argument.ends_with(".h5") || argument.ends_with(".hdf5");
    if (is_file && !out.empty() && out.back() == "--restart") {
      out.back() += "=" + argument;
    } else {
      out.push_back(argument);
    }
  }
  return out;
}

void add_case(CLI::App& app, CommandLine& line) {
  app.add_option("CASE", line.case_file, "Case file (TOML)")->required();
  app.add_option("--set", line.settings,
                 "Give a key of the case file another value; may be repeated")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
}

/// What is wrong with the choice of a command; empty when nothing is. Asked before CLI11 parses,
/// which would take a mistyped command for an argument.
std::string command_mistake(const std::vector<std::string>& arguments) {
  const std::vector<std::string> commands{"run", "check", "options"};
  const auto all = fmt::format("the commands are {}.", quoted_words(commands, "and"));
  if (arguments.size() < 2) return "No command is given; " + all;
  const auto& word = arguments[1];
  const bool is_known = std::find(commands.begin(), commands.end(), word) != commands.end();
  if (is_known || word.starts_with("-")) return {};
  if (word == "init" || word == "plot") {
    return fmt::format("The command \"{}\" is known, but this version does not have it yet; {}",
                       word, all);
  }
  return fmt::format("There is no command \"{}\"{}", word,
                     did_you_mean(word, commands, "; " + all));
}

std::string sentence_of(const CLI::Error& error, const std::vector<std::string>& arguments) {
  const bool lacks_case = dynamic_cast<const CLI::RequiredError*>(&error) && arguments.size() > 1;
  if (!lacks_case || arguments[1].starts_with("-")) return error.what();
  return fmt::format("The command \"{0}\" needs a case file, as in \"cdca {0} CASE.toml\".",
                     arguments[1]);
}

std::string default_directory(const std::string& case_file) {
  return (std::filesystem::path("results") / std::filesystem::path(case_file).stem()).string();
}

}  // namespace

CommandLine parse_command_line(const std::vector<std::string>& arguments) {
  CommandLine line;
  line.text = command_mistake(arguments);
  if (!line.text.empty()) {
    line.command = CommandLine::Command::mistaken;
    return line;
  }
  const auto release = fmt::format("cdca {}", version);
  CLI::App app("Growing cracks by the continuous-discontinuous cellular automaton method.", "cdca");
  app.footer(epilogue);
  app.require_subcommand(1);
  auto& run = *app.add_subcommand("run", "Run a case; works alone and under mpirun");
  auto& check = *app.add_subcommand("check", "Read and check a case, and say what was understood");
  auto& options =
      *app.add_subcommand("options", "Print the manual page of the case file (Markdown)");
  for (auto* part : {&app, &run, &check, &options}) part->set_version_flag("--version", release);
  add_case(run, line);
  run.add_option("-o,--output", line.directory, "Result folder; default results/<name of the case>")
      ->type_name("DIR");
  run.add_flag("--quiet", line.quiet, "Print errors only");
  const std::string newest = "newest";
  std::string checkpoint;
  run.add_flag("--restart{newest}", checkpoint,
               "Go on from the newest checkpoint of the result folder, or from a given one: "
               "--restart FILE.h5");
  add_case(check, line);

  try {
    auto reversed = with_repeated_set(with_joined_restart(arguments));
    std::reverse(reversed.begin(), reversed.end());
    if (!reversed.empty()) reversed.pop_back();  // the program's name
    app.parse(reversed);
  } catch (const CLI::Success& success) {
    std::ostringstream out;
    app.exit(success, out, out);
    line.text = out.str();
    return line;
  } catch (const CLI::Error& error) {
    line.command = CommandLine::Command::mistaken;
    line.text = sentence_of(error, arguments);
    return line;
  }
  if (run.parsed()) line.command = CommandLine::Command::run;
  line.restarts = !checkpoint.empty();
  if (checkpoint != newest) line.checkpoint = checkpoint;
  if (check.parsed()) line.command = CommandLine::Command::check;
  if (options.parsed()) line.command = CommandLine::Command::options;
  if (line.directory.empty()) line.directory = default_directory(line.case_file);
  return line;
}

}  // namespace cdca
