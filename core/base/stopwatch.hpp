// SPDX-License-Identifier: BSD-3-Clause
/// Wall-clock time.
#pragma once

#include <chrono>

namespace cdca {

class Stopwatch {
 public:
  /// Since construction or the last restart, s.
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  void restart() { start_ = std::chrono::steady_clock::now(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace cdca
