// SPDX-License-Identifier: BSD-3-Clause
/// Whether there are other ranks to talk to.
#pragma once

namespace cdca {

/// True when mpirun, srun or the like started this process, as their environment variables tell.
/// Without them MPI is better left alone: a lone process that starts it pays for a helper process,
/// and Open MPI 4.1 lets a few in a thousand of them crash or hang at their end on a loaded
/// machine.
bool started_by_launcher();

}  // namespace cdca
