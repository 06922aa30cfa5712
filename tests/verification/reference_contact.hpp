// SPDX-License-Identifier: BSD-3-Clause
/// Reference cases whose faces touch, as far as they show more than K.
#pragma once

#include "tests/verification/reference_report.hpp"
#include "tests/verification/reference_solve.hpp"

namespace cdca::testing {

/// K at every tip of a case, at full load.
ReferenceResult tip_intensities(const ReferenceCase& reference, const ReferenceGrid& grid);
/// The same, with and without friction, and where the faces close.
ReferenceResult partly_closed(const ReferenceCase& reference);
/// What the flaw and the material of the paper's sections 5.2 and 5.3 give: K_II, the stress at
/// which wings begin, and how far a wing's stress is above the strength.
ReferenceResult paper_numbers(const ReferenceCase& reference);

/// "80 x 160"
std::string size_of(const ReferenceGrid& grid);

}  // namespace cdca::testing
