// SPDX-License-Identifier: BSD-3-Clause
/// Prescribed displacements: which unknowns are held, and at which values.
#pragma once

#include "core/cells/part_basis.hpp"
#include "core/mechanics/boundary_spec.hpp"

#include <vector>

namespace cdca {

/// A held unknown. Its value is a weighted sum of the prescribed function at a few places: at the
/// node itself, or, where a crack cuts the node off from its piece, a fit on the piece's own part
/// of the side.
struct HeldUnknown {
  LocalId unknown = 0;
  std::size_t block = 0;  ///< of the boundary blocks
  int component = 0;
  struct Sample {
    Vec2 at{0, 0};  ///< m
    double weight = 1.0;
  };
  std::vector<Sample> samples;
};

class Supports {
 public:
  Supports() = default;
  /// Looks at own cells only. Where two blocks hold the same unknown, the first one counts.
  Supports(const BasisContext& context, const std::vector<BoundarySpec>& blocks);

  const std::vector<HeldUnknown>& held() const { return held_; }
  /// For all unknowns of this rank, ghosts never.
  std::vector<char> flags(LocalId count) const;
  /// Writes the prescribed values at load factor s into u (m).
  void prescribe(const std::vector<BoundarySpec>& blocks, double s, std::span<double> u) const;

 private:
  std::vector<HeldUnknown> held_;
};

}  // namespace cdca
