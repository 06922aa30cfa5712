// SPDX-License-Identifier: BSD-3-Clause
#include "io/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <unistd.h>

namespace cdca {
namespace {

constexpr int bar_width = 40;
constexpr const char* clear_line = "\r\x1b[K";

std::string duration(double seconds) {
  if (!(seconds >= 0.0)) return "?";
  if (seconds < 10.0) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

/// The active tip with the largest K_I.
std::optional<double> largest_k1(const Summary& summary) {
  std::optional<double> largest;
  for (const TipRecord& tip : summary.tips)
    if (tip.state == "active") largest = std::max(largest.value_or(tip.k1), tip.k1);
  return largest;
}

}  // namespace

bool is_terminal() {
  if (isatty(STDOUT_FILENO) == 0) return false;
  if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr) return true;
  // Open MPI gives its ranks a terminal of their own: what counts is where mpirun itself writes.
  std::error_code error;
  const auto target =
      std::filesystem::read_symlink(fmt::format("/proc/{}/fd/1", getppid()), error).string();
  return !error && (target.starts_with("/dev/pts/") || target.starts_with("/dev/tty"));
}

std::string step_line(const Summary& summary, int total_steps) {
  const StepRecord& step = summary.steps.back();
  std::string text =
      fmt::format("step {}/{}  load {:.4g}", step.step, total_steps, step.load_factor);
  if (const auto k1 = largest_k1(summary))
    text += fmt::format("  K_I {:.4g} MPa m^1/2", *k1 * 1e-6);
  return text + fmt::format("  tips {}  growth cycles {}  iterations {}  wall {}", step.active_tips,
                            step.growth_cycles, step.solver_iterations, duration(step.wall_s));
}

std::string progress_bar(int done, int total, double elapsed_s, int before) {
  const double share = total > 0 ? std::clamp(static_cast<double>(done) / total, 0.0, 1.0) : 0.0;
  const auto full = static_cast<std::size_t>(share * bar_width);
  const std::string left = done > before
                               ? duration(elapsed_s * (total - done) / (done - before)) + " left"
                               : "time left unknown";
  return fmt::format("[{}{}] {:.0f} %, {}", std::string(full, '#'),
                     std::string(bar_width - full, '-'), 100.0 * share, left);
}

ProgressLog::ProgressLog(std::FILE* out, int total_steps, bool bar)
    : out_(out), total_steps_(total_steps), bar_(bar), start_(std::chrono::steady_clock::now()) {}

void ProgressLog::on_start(const Summary& summary) {
  start_ = std::chrono::steady_clock::now();
  steps_before_ = static_cast<int>(summary.steps.size());
  line(fmt::format("{}: {} elements, {} nodes, {} unknowns on {} rank{}",
                   summary.title.empty() ? "run" : summary.title, summary.elements, summary.nodes,
                   summary.unknowns, summary.ranks, summary.ranks == 1 ? "" : "s"));
}

void ProgressLog::on_step(const StepView& view) {
  line(step_line(view.summary, total_steps_));
  if (out_ == nullptr || !bar_ || view.last) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  fmt::print(
      out_, "{}",
      progress_bar(view.summary.steps.back().step, total_steps_, elapsed.count(), steps_before_));
  std::fflush(out_);
}

void ProgressLog::on_finish(const Summary& summary) {
  line(summary.message.empty() ? summary.status : summary.status + ": " + summary.message);
}

void ProgressLog::line(const std::string& text) {
  if (out_ == nullptr) return;
  fmt::print(out_, "{}{}\n", bar_ ? clear_line : "", text);
  std::fflush(out_);
}

}  // namespace cdca
