// SPDX-License-Identifier: BSD-3-Clause
/// How a run is asked to stop: SIGTERM, SIGINT (Ctrl-C), or SIGUSR1, which mpirun passes on.
#pragma once

namespace cdca {

/// From now on these signals end nothing: stop_was_asked() tells of them. A second SIGINT ends the
/// program as usual.
void catch_stop_signals();

bool stop_was_asked();

}  // namespace cdca
