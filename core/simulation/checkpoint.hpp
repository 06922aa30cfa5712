// SPDX-License-Identifier: BSD-3-Clause
/// All that a run needs to go on from where it was, on any number of ranks.
#pragma once

#include "core/simulation/cell_fields.hpp"
#include "core/simulation/energy_ledger.hpp"
#include "core/simulation/model.hpp"
#include "core/simulation/snapshot.hpp"

namespace cdca {

/// Where a run stands between two growth cycles.
struct Progress {
  int steps = 0;                ///< load steps (critical mode: growth events) that are done
  int cycles = 0;               ///< growth cycles done in the one under way
  double load_factor = 0.0;     ///< of the last equilibrium
  double largest_factor = 0.0;  ///< so far; critical mode
  double first_factor = 0.0;    ///< of the first growth; critical mode
  bool joined = true;  ///< the body joins its loaded boundaries, but for what growth may have cut
};

/// What has been told of a run so far.
struct RunStory {
  std::vector<StepRecord> steps;
  std::vector<TipRecord> tips;        ///< at the end of the last load step
  std::vector<TipRecord> cycle_tips;  ///< of the growth cycles of the load step under way
  PerformanceRecord performance;
  /// Of the load step under way, as in StepRecord.
  int step_iterations = 0;
  int step_contact_iterations = 0;
  double step_contact_unbalanced = 0.0;
};

/// The same on every rank, but for the cells: these are some rows, each on one rank.
struct Checkpoint {
  Progress progress;
  RunStory story;
  EnergyTotals energy;
  std::vector<Crack> cracks;
  std::vector<Event> events;
  std::vector<ContactPatch> patches;
  CellFields cells;
};

/// Collective.
Checkpoint take_checkpoint(const Model& model, const EnergyLedger& energy, const Progress& progress,
                           RunStory story);

/// Brings a model of the same case to the state of a checkpoint, stiffness included, and returns
/// the energies. Throws IoError where they do not fit. Collective.
EnergyLedger put_back(const Checkpoint& checkpoint, Model& model);

}  // namespace cdca
