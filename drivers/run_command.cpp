// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run_command.hpp"

#include "cdca_version.hpp"
#include "core/simulation/simulation.hpp"
#include "drivers/restart.hpp"
#include "drivers/stop_signals.hpp"
#include "io/case_file.hpp"
#include "io/checkpoint_writer.hpp"
#include "io/log.hpp"
#include "io/result_writer.hpp"
#include "parallel/metis_partition.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace cdca {

namespace {

/// Where the results of the run that goes on lie; none for a new run.
std::optional<std::filesystem::path> folder_of(const std::optional<Restart>& restart) {
  if (!restart) return std::nullopt;
  const auto folder = restart->file.parent_path();
  return folder.empty() ? std::filesystem::path(".") : folder;
}

}  // namespace

bool run_command(const CommandLine& line, Communicator& ranks) {
  const auto spec = read_case(line.case_file, line.settings, ranks);
  const bool speaks = ranks.is_root() && !line.quiet;
  const auto restart = find_restart(line, spec, ranks);
  if (restart && speaks) fmt::print("going on from {}\n", restart->file.string());
  ResultWriter writer(line.directory, spec.output.every, ranks, spec.effective, folder_of(restart));
  CheckpointWriter checkpoints(line.directory, spec.output.checkpoint_every,
                               {version, spec.title, spec.effective}, stop_was_asked, ranks,
                               restart ? std::optional(restart->file) : std::nullopt);
  const int total =
      spec.loading.critical ? spec.loading.max_events : static_cast<int>(spec.load_factors.size());
  ProgressLog log(speaks ? stdout : nullptr, total, speaks && is_terminal());
  const std::array<Observer*, 3> observers{&writer, &checkpoints, &log};
  catch_stop_signals();
  const Summary summary = run_simulation(spec, version, ranks, metis_partition, observers,
                                         restart ? &restart->checkpoint : nullptr);
  if (speaks) fmt::print("results in {}\n", line.directory);
  return spec.output.pictures && summary.status != "running";
}

}  // namespace cdca
