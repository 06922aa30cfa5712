// SPDX-License-Identifier: BSD-3-Clause
/// The memory of this process.
#pragma once

#include <cstdint>

namespace cdca {

/// Largest resident size so far, bytes; 0 where the system does not tell.
std::int64_t peak_memory_bytes();

/// Memory that is freed stays with the process, for what it asks for next. Every solve takes and
/// frees arrays as long as the state; getting them from the system anew, page by page, can cost as
/// much time as filling them with results. To be called before anything large is allocated.
void keep_freed_memory();

}  // namespace cdca
