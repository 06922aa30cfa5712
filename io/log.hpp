// SPDX-License-Identifier: BSD-3-Clause
/// What a run says while it goes: one line per load step, and a bar with the time left on a
/// terminal.
#pragma once

#include "core/simulation/observer.hpp"

#include <chrono>
#include <cstdio>
#include <string>

namespace cdca {

/// True when a person watches standard output, also through mpirun.
bool is_terminal();

/// "step 3/10  load 0.30  K_I 4.95 MPa m^1/2  tips 2  grown 0  iterations 45  wall 1.2 s".
std::string step_line(const Summary& summary, int total_steps);

/// "[######------------] 33 %, 2 min 5 s left", the time guessed from the steps done so far, those
/// not counted that were done before the run was continued.
std::string progress_bar(int done, int total, double elapsed_s, int before = 0);

/// Prints on the rank that is given an output, and nothing on the others or when quiet.
class ProgressLog final : public Observer {
 public:
  /// `out`: where to print, or null to stay silent; `bar`: draw the bar as well (on terminals).
  ProgressLog(std::FILE* out, int total_steps, bool bar);

  void on_start(const Summary& summary) override;
  void on_step(const StepView& view) override;
  void on_finish(const Summary& summary) override;

 private:
  void line(const std::string& text);

  std::FILE* out_;
  int total_steps_;
  int steps_before_ = 0;  ///< done before the run was continued
  bool bar_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace cdca
