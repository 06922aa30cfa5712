// SPDX-License-Identifier: BSD-3-Clause
/// The result folder: everything that a run leaves behind, written as it goes.
#pragma once

#include "core/base/communicator.hpp"
#include "core/simulation/observer.hpp"
#include "io/paraview_index.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace cdca {

/// Writes summary.json, history.csv and tips.csv after every load step, and the ParaView files
/// every `every` steps and at the last one. A failure on any rank is an IoError on all ranks.
class ResultWriter final : public Observer {
 public:
  /// Makes the folder, so that a run which cannot write fails before it computes; all ranks
  /// together. `effective_case` is the case with all defaults filled in, kept as effective.toml;
  /// may be empty. `continued`: the result folder of the run that goes on, mostly the same one.
  ResultWriter(std::filesystem::path directory, int every, Communicator& comm,
               std::string effective_case = {},
               std::optional<std::filesystem::path> continued = {});

  /// Removes what an earlier run left in the folder, and nothing else that lies there; of the run
  /// that goes on, what it wrote after the steps of the summary.
  void on_start(const Summary& summary) override;
  void on_step(const StepView& view) override;
  void on_finish(const Summary& summary) override;

 private:
  void write_tables(const Summary& summary) const;
  void write_paraview(const StepView& view);

  std::filesystem::path directory_;
  int every_;
  Communicator& comm_;
  std::string effective_case_;
  std::optional<std::filesystem::path> continued_;
  ParaviewSeries fields_;
  ParaviewSeries cracks_;
};

}  // namespace cdca
