// SPDX-License-Identifier: BSD-3-Clause
/// Lists in ascending order.
#pragma once

#include <algorithm>
#include <vector>

namespace cdca {

/// Sorts, and leaves each value once.
template <class Value>
void sort_once(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace cdca
