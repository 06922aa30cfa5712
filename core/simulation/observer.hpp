// SPDX-License-Identifier: BSD-3-Clause
/// Who wants to see a run go by: writers of results, the progress line, tests.
#pragma once

#include "core/simulation/snapshot.hpp"

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

/// Called on all ranks together, in the order on_start, on_step for every load step, on_finish. A
/// run that fails after on_start still ends with on_finish, and a summary that says so.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void on_start(const Summary& /*summary*/) {}
  virtual void on_step(const StepView& /*view*/) {}
  virtual void on_finish(const Summary& /*summary*/) {}
};

}  // namespace cdca
