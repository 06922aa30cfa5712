// SPDX-License-Identifier: BSD-3-Clause
#include "io/checkpoint_writer.hpp"

#include "io/checkpoint_folder.hpp"
#include "parallel/together.hpp"

#include <system_error>
#include <utility>

namespace cdca {

CheckpointWriter::CheckpointWriter(std::filesystem::path directory, int every,
                                   CheckpointOrigin origin, std::function<bool()> is_to_stop,
                                   Communicator& ranks,
                                   std::optional<std::filesystem::path> continued)
    : directory_(std::move(directory)),
      every_(every),
      origin_(std::move(origin)),
      is_to_stop_(std::move(is_to_stop)),
      ranks_(ranks),
      continued_(std::move(continued)) {}

void CheckpointWriter::on_start(const Summary&) {
  together(ranks_, [&] {
    if (!ranks_.is_root()) return;
    std::error_code error;
    const bool is_here = continued_ && std::filesystem::equivalent(
                                           *continued_, directory_ / continued_->filename(), error);
    const auto step = is_here ? checkpoint_step(*continued_) : std::nullopt;
    remove_checkpoints_after(directory_, step.value_or(-1));
  });
}

bool CheckpointWriter::on_rest(const RestPoint& point) {
  const bool asked = ranks_.max(is_to_stop_() ? 1.0 : 0.0) > 0.0;
  const bool stops = asked && !point.last;  // a run that is over does not stop on its way
  const bool is_due = every_ > 0 && point.ends_step() && point.step() % every_ == 0;
  if (!stops && !is_due) return false;
  write_checkpoint(checkpoint_path(directory_, point.step()), point.checkpoint(), origin_, ranks_);
  together(ranks_, [&] {
    if (ranks_.is_root()) keep_newest_checkpoints(directory_, 2);
  });
  return stops;
}

}  // namespace cdca
