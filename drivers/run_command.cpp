// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run_command.hpp"

#include "cdca_version.hpp"
#include "core/simulation/simulation.hpp"
#include "io/case_file.hpp"
#include "io/log.hpp"
#include "io/result_writer.hpp"
#include "parallel/metis_partition.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>

namespace cdca {

bool run_command(const CommandLine& line, Communicator& ranks) {
  const auto spec = read_case(line.case_file, line.settings, ranks);
  const bool speaks = ranks.is_root() && !line.quiet;
  ResultWriter writer(line.directory, spec.output.every, ranks, spec.effective);
  const int total =
      spec.loading.critical ? spec.loading.max_events : static_cast<int>(spec.load_factors.size());
  ProgressLog log(speaks ? stdout : nullptr, total, speaks && is_terminal());
  const std::array<Observer*, 2> observers{&writer, &log};
  run_simulation(spec, version, ranks, metis_partition, observers);
  if (speaks) fmt::print("results in {}\n", line.directory);
  return spec.output.pictures;
}

}  // namespace cdca
