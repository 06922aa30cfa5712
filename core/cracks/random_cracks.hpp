// SPDX-License-Identifier: BSD-3-Clause
/// Seeded random cracks.
#pragma once

#include "core/cracks/crack_registry.hpp"

#include <cstdint>
#include <vector>

namespace cdca {

/// Straight cracks with uniform centre, length and angle.
struct CrackFieldSpec {
  int count = 0;
  double length[2] = {0, 0};   ///< m, smallest and largest
  double angle[2] = {0, 180};  ///< degrees from x
  Rectangle region;            ///< holds the whole cracks
  std::uint64_t seed = 0;
};

/// End points of every crack, m; the same for a seed on every machine and number of ranks. Cracks
/// that would reach out of the region are drawn again.
std::vector<std::array<Vec2, 2>> random_cracks(const CrackFieldSpec& spec);

}  // namespace cdca
