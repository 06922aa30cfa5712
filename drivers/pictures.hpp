// SPDX-License-Identifier: BSD-3-Clause
/// Pictures of a result folder, drawn by a script of its own.
#pragma once

#include <string>

namespace cdca {

/// Draws the pictures of a result folder, and waits for them. A failure is told in one line on
/// standard error and has no other effect: the results are there. Not while MPI is running, since
/// MPI does not support child processes everywhere.
void draw_pictures(const std::string& directory, bool quiet);

}  // namespace cdca
