// SPDX-License-Identifier: BSD-3-Clause
/// Values that the command line sets over those of the case file.
#pragma once

#include "io/config_node.hpp"

#include <string>
#include <vector>

namespace cdca {

/// Applies "key.path=value" settings in their order. Blocks and list entries are counted from 0, as
/// in "boundary[1].traction=[0, 1e6]" or "boundary.1.traction=...". The value is TOML; what is not
/// TOML counts as text, so that words need no quotes. Keys are checked later, with those of the
/// file. Settings that cannot be applied are added to `problems`.
void apply_overrides(ConfigNode& root, const std::vector<std::string>& settings,
                     std::vector<Problem>& problems);

}  // namespace cdca
