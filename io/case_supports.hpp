// SPDX-License-Identifier: BSD-3-Clause
/// Supports and loads of a case as a whole: do they contradict each other, do they hold the body?
#pragma once

#include "core/simulation/case_spec.hpp"
#include "io/config_node.hpp"

#include <vector>

namespace cdca {

/// Reports components that are prescribed twice at one place, or prescribed and loaded, and rigid
/// motions that no support holds. The boundaries of `spec` must be one per [[boundary]] block, in
/// order.
void check_supports(const ConfigNode& root, const CaseSpec& spec, std::vector<Problem>& problems);

}  // namespace cdca
