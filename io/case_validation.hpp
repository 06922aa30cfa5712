// SPDX-License-Identifier: BSD-3-Clause
/// The values of a case file against the table of options.
#pragma once

#include "io/config_node.hpp"

#include <vector>

namespace cdca {

/// Checks names, types, ranges and words of everything in `root`, adds what is wrong to `problems`
/// and takes it out of `root`; then fills in the defaults. Afterwards every value in `root` is of
/// the declared kind and in its range, and every section that is no block is there. Rules between
/// several keys, and what expressions say, are checked where the case is built.
void validate_case(ConfigNode& root, std::vector<Problem>& problems);

}  // namespace cdca
