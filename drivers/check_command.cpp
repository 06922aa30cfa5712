// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/check_command.hpp"

#include "core/simulation/simulation.hpp"
#include "io/case_describe.hpp"
#include "io/case_file.hpp"
#include "parallel/metis_partition.hpp"

#include <fmt/format.h>

namespace cdca {

void check_command(const CommandLine& line, Communicator& ranks) {
  const auto spec = read_case(line.case_file, line.settings, ranks);
  const auto measure = measure_case(spec, ranks, metis_partition);
  const CaseSize size{measure.elements, measure.nodes, measure.unknowns, measure.active_tips,
                      measure.bytes};
  if (ranks.is_root()) fmt::print("{}", describe_case(spec, size));
}

}  // namespace cdca
