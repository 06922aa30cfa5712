// SPDX-License-Identifier: BSD-3-Clause
/// The story of a run, and its telling to the observers.
#pragma once

#include "core/base/stopwatch.hpp"
#include "core/simulation/energy_ledger.hpp"
#include "core/simulation/growth.hpp"
#include "core/simulation/observer.hpp"

#include <span>

namespace cdca {

/// One load step (or one growth event in critical mode) as it ended.
struct StepResult {
  int step = 0;
  double load_factor = 0.0;
  int growth_cycles = 0;
  bool last = false;
};

/// Builds the summary as the run goes on and shows it to the observers.
class Recorder {
 public:
  Recorder(const CaseSpec& spec, const std::string& version, Communicator& communicator,
           std::span<Observer* const> observers);

  const Summary& summary() const { return summary_; }

  /// `before`: the story of a run that goes on.
  void start(const Model& model, RunStory before = {});
  /// Every linear solve of the run, the trial ones included.
  void solved(const Equilibrium& equilibrium, double seconds);
  /// The tips of one growth cycle, and what the growing ones did.
  void cycle(const Model& model, int step, int cycle, const std::vector<TipAssessment>& tips,
             const std::vector<Increment>& increments);
  void step(const Model& model, const StepResult& result, const Equilibrium& equilibrium,
            const EnergyLedger& energy, const std::vector<TipAssessment>& tips);
  /// Between growth cycles and load steps; true: the run is to stop here. Collective.
  bool rest(const Model& model, const EnergyLedger& energy, const Progress& progress,
            bool last = false);
  /// How the run ended: "completed" unless said otherwise.
  void set_status(const std::string& status, const std::string& message);
  void finish();
  void fail(const std::string& message);

 private:
  StepRecord step_record(const Model& model, const StepResult& result, const Equilibrium& e,
                         const EnergyLedger& energy) const;
  void record_cracks(const Model& model);
  void record_tips(const Model& model, int step, const std::vector<TipAssessment>& tips);
  void measure(LocalId owned);
  double seconds() const { return seconds_before_ + watch_.seconds(); }

  const CaseSpec& spec_;
  Communicator& communicator_;
  std::span<Observer* const> observers_;
  Stopwatch watch_;
  Summary summary_;
  std::vector<TipRecord> cycle_tips_;
  int iterations_of_step_ = 0;
  int contact_iterations_of_step_ = 0;
  double contact_unbalanced_of_step_ = 0.0;
  double seconds_before_ = 0.0;  ///< that the run took before it was continued
  bool started_ = false;
  bool left_ = false;  ///< stopped before its end
};

}  // namespace cdca
