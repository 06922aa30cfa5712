// SPDX-License-Identifier: BSD-3-Clause
/// When and how cracks grow, and how the load follows.
#pragma once

#include "core/simulation/case_spec.hpp"
#include "io/config_node.hpp"

#include <vector>

namespace cdca {

/// Reports a critical loading without a criterion, or with load factors of its own.
LoadingSpec build_loading(const ConfigNode& root, std::vector<Problem>& problems);

/// Reports a criterion that the material of `spec` has no values for, and steps that are no fixed
/// ones or longer than its body.
GrowthSpec build_growth(const ConfigNode& root, const CaseSpec& spec,
                        std::vector<Problem>& problems);

}  // namespace cdca
