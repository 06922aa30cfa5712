// SPDX-License-Identifier: BSD-3-Clause
/// Who wants to see a run go by: writers of results, the progress line, tests.
#pragma once

#include "core/simulation/checkpoint.hpp"

#include <functional>
#include <vector>

namespace cdca {

/// What there is to see after a load step. The references hold during the call only.
struct StepView {
  const Summary& summary;  ///< summary.steps.back() is the step just done
  std::function<FieldPart()>
      fields;  ///< this rank's part; computed when asked for, by all ranks together
  std::function<CrackPart()> cracks;  ///< as fields()
  const std::vector<TipRecord>&
      cycle_tips;  ///< every active tip of every growth cycle of this step
  bool last;       ///< no step follows
};

/// A place between two growth cycles or load steps where a run can be left, to go on later.
struct RestPoint {
  const Progress& progress;
  std::function<Checkpoint()> checkpoint;  ///< with the cells of this rank; made when asked for
  bool last;                               ///< nothing is left to be done

  bool ends_step() const { return progress.cycles == 0; }
  /// The load step that ends here, or the one under way.
  int step() const { return progress.steps + (ends_step() ? 0 : 1); }
};

/// Called on all ranks together, in the order on_start, on_step for every load step, on_finish. A
/// run that fails after on_start still ends with on_finish, and a summary that says so.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void on_start(const Summary& /*summary*/) {}
  virtual void on_step(const StepView& /*view*/) {}
  /// True, on all ranks, ends the run here for now.
  virtual bool on_rest(const RestPoint& /*point*/) { return false; }
  virtual void on_finish(const Summary& /*summary*/) {}
};

}  // namespace cdca
