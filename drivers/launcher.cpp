// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/launcher.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace cdca {

bool started_by_launcher() {
  // Open MPI; PMIx (Open MPI, Slurm); PMI (MPICH, Intel MPI, Slurm); MVAPICH; Slurm.
  constexpr std::array names{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "MV2_COMM_WORLD_RANK",
                             "SLURM_PROCID"};
  return std::any_of(names.begin(), names.end(),
                     [](const char* name) { return std::getenv(name) != nullptr; });
}

}  // namespace cdca
