// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/process_memory.hpp"

#include <sys/resource.h>

namespace cdca {

std::int64_t peak_memory_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return std::int64_t(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

}  // namespace cdca
