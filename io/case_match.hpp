// SPDX-License-Identifier: BSD-3-Clause
/// Whether a run can go on with a case that may have been changed since.
#pragma once

#include <string>

namespace cdca {

/// Throws InputError that names the first key that differs where it must not: only title, load
/// steps, growth, solver and output may change. The texts are effective inputs
/// (case_effective.hpp); `origin` names the run that was left, as in "checkpoint-10.h5".
void require_same_case(const std::string& before, const std::string& now,
                       const std::string& origin);

}  // namespace cdca
