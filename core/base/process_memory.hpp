// SPDX-License-Identifier: BSD-3-Clause
/// How much memory this process has used.
#pragma once

#include <cstdint>

namespace cdca {

/// Largest resident size so far, bytes; 0 where the system does not tell.
std::int64_t peak_memory_bytes();

}  // namespace cdca
