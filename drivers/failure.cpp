// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/failure.hpp"

#include "core/base/errors.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <thread>

namespace cdca {
namespace {

std::string problem_text(const Problem& problem, const std::string& case_file) {
  std::string text = "cdca: " + case_file;
  if (problem.line > 0) text += fmt::format(":{}", problem.line);
  if (!problem.key.empty()) text += ": " + problem.key;
  return fmt::format("{}: {}\n", text, problem.message);
}

std::string input_text(const InputError& error, const std::string& case_file) {
  std::string text;
  for (const auto& problem : error.problems()) text += problem_text(problem, case_file);
  return text;
}

void print_error(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

/// Ends this process, and so the run, when it is still there after a while. Not by MPI_Abort: the
/// main thread waits inside of MPI then, which no second thread may enter.
void leave_after(double seconds, const Failure& failure, bool is_printed) {
  std::thread([=] {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    if (!is_printed) print_error(failure.text);
    std::_Exit(static_cast<int>(failure.status));
  }).detach();
}

}  // namespace

Failure failure_of(const std::exception& error, const std::string& case_file) {
  if (const auto* input = dynamic_cast<const InputError*>(&error)) {
    return {ExitStatus::wrong_input, input_text(*input, case_file)};
  }
  const auto text = fmt::format("cdca: {}\n", error.what());
  if (dynamic_cast<const IoError*>(&error)) return {ExitStatus::failed_io, text};
  if (dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return {ExitStatus::failed_io, text};
  if (dynamic_cast<const SolveError*>(&error)) return {ExitStatus::failed_solve, text};
  if (dynamic_cast<const std::bad_alloc*>(&error)) {
    return {ExitStatus::failed_solve, "cdca: There is not enough memory for this case.\n"};
  }
  return {ExitStatus::failed_solve,
          fmt::format("cdca: This should not have happened: {}\n", error.what())};
}

ExitStatus run_guarded(const std::function<void()>& job, const std::string& case_file,
                       const Communicator& ranks, double patience_s) {
  try {
    job();
    return ExitStatus::done;
  } catch (const std::exception& error) {
    const auto failure = failure_of(error, case_file);
    if (ranks.is_root()) print_error(failure.text);
    if (ranks.size() > 1) leave_after(patience_s, failure, ranks.is_root());
    return failure.status;
  }
}

}  // namespace cdca
