// SPDX-License-Identifier: BSD-3-Clause
/// What a case is, in words and numbers, for `cdca check`.
#pragma once

#include "core/simulation/case_spec.hpp"

#include <cstdint>
#include <string>

namespace cdca {

/// How large the problem is; whoever builds the model knows.
struct CaseSize {
  std::int64_t elements = 0;
  std::int64_t nodes = 0;
  std::int64_t unknowns = 0;
  int tips = 0;            ///< crack ends that end in the body, not on its sides or on other cracks
  std::int64_t bytes = 0;  ///< memory expected, all ranks together
};

/// A few lines on sizes, cells, material, cracks, loads, unknowns and memory.
std::string describe_case(const CaseSpec& spec, const CaseSize& size);

/// Bytes for people: "1.4 GB".
std::string bytes_text(std::int64_t bytes);

}  // namespace cdca
