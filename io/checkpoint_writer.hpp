// SPDX-License-Identifier: BSD-3-Clause
/// Writes checkpoints as a run goes on, and lets it be stopped.
#pragma once

#include "core/simulation/observer.hpp"
#include "io/checkpoint_file.hpp"

#include <filesystem>
#include <functional>
#include <optional>

namespace cdca {

/// A checkpoint after every `every` load steps, the newest two of which are kept, and one when the
/// run is asked to stop; it stops then. A failure on any rank is an IoError on all ranks.
class CheckpointWriter final : public Observer {
 public:
  /// `is_to_stop`: looked at between growth cycles; one rank that says so is enough. every = 0: no
  /// checkpoint but that one. `continued`: the checkpoint from which the run goes on.
  CheckpointWriter(std::filesystem::path directory, int every, CheckpointOrigin origin,
                   std::function<bool()> is_to_stop, Communicator& ranks,
                   std::optional<std::filesystem::path> continued = {});

  /// Removes the checkpoints that an earlier run left in the folder; of the run that goes on, those
  /// of later steps only.
  void on_start(const Summary& summary) override;
  bool on_rest(const RestPoint& point) override;

 private:
  std::filesystem::path directory_;
  int every_;
  CheckpointOrigin origin_;
  std::function<bool()> is_to_stop_;
  Communicator& ranks_;
  std::optional<std::filesystem::path> continued_;
};

}  // namespace cdca
