// SPDX-License-Identifier: BSD-3-Clause
/// From validated values to the case that the simulation takes.
#pragma once

#include "core/simulation/case_spec.hpp"
#include "io/config_node.hpp"

#include <vector>

namespace cdca {

/// Builds the case from what validate_case() left. Rules between several keys are checked here;
/// what breaks them is added to `problems`, and the case must not be used when there are any.
CaseSpec build_case(const ConfigNode& root, std::vector<Problem>& problems);

}  // namespace cdca
