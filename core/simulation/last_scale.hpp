// SPDX-License-Identifier: BSD-3-Clause
/// How large the last scale of a case is, which is factored whole.
#pragma once

#include "core/simulation/case_spec.hpp"

namespace cdca {

/// The most nodes of that scale. Where this is the whole grid, the body is condensed to its
/// touching faces: a factor takes longer then, but faces settle without the body. That pays on
/// larger grids where there are many faces, whose turns on the whole body are many, too; which is
/// told by the length of the initial cracks. Cohesive faces do not settle so.
std::int64_t most_nodes_of_last_scale(const CaseSpec& spec);

}  // namespace cdca
