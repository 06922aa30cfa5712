// SPDX-License-Identifier: BSD-3-Clause
/// Supports and loads of a case, block by block.
#pragma once

#include "core/simulation/case_spec.hpp"
#include "io/config_node.hpp"

#include <vector>

namespace cdca {

/// Fills `spec.boundaries`, one per [[boundary]] block and in order; domain, cracks and load
/// factors of `spec` must be there. Reports blocks without a place or with an unknown one, keys
/// that do not go with the place, blocks that do nothing, and expressions that cannot be used.
void build_boundaries(const ConfigNode& root, CaseSpec& spec, std::vector<Problem>& problems);

}  // namespace cdca
