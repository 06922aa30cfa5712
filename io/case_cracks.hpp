// SPDX-License-Identifier: BSD-3-Clause
/// The initial cracks of a case, and what is wrong with them.
#pragma once

#include "core/simulation/case_spec.hpp"
#include "io/config_node.hpp"

#include <string>
#include <vector>

namespace cdca {

/// One crack per block, in order; one whose place is wrong has no points. Reports doubled names,
/// missing places, and what check_crack_geometry() finds.
std::vector<CrackSpec> build_cracks(const ConfigNode& root, const DomainSpec& domain,
                                    std::vector<Problem>& problems);

/// Appends the cracks of [crack_field], named "random1", "random2", ...; none where the table is
/// absent or wrong.
void add_random_cracks(const ConfigNode& root, CaseSpec& spec, std::vector<Problem>& problems);

/// Reports cracks that leave the body, have segments of no length, turn back, cross themselves, run
/// along a side, or lie on each other. Whether the grid can hold them, the model finds out.
/// `blocks` are where the cracks were written.
void check_crack_geometry(const std::vector<CrackSpec>& cracks, const DomainSpec& domain,
                          const std::vector<ConfigNode>& blocks, std::vector<Problem>& problems);

}  // namespace cdca
