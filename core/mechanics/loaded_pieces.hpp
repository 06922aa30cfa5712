// SPDX-License-Identifier: BSD-3-Clause
/// Which pieces of cells the loaded boundaries touch.
#pragma once

#include "core/cells/bodies.hpp"
#include "core/mechanics/boundary_spec.hpp"

#include <cstdint>
#include <vector>

namespace cdca {

/// One bit for every side with a displacement or a traction. A body with fewer than two such sides
/// in all counts its supports and forces at points as well. Another bit tells that forces act:
/// a traction that is not zero, or a force at a point.
class LoadedPieces {
 public:
  static constexpr std::uint64_t forces = std::uint64_t(1) << 8;
  static constexpr std::uint64_t boundaries = ~forces;

  LoadedPieces(const BasisContext& context, const std::vector<BoundarySpec>& blocks);

  /// Bits of pieces of this rank, in no order; one piece may be listed several times.
  const std::vector<PieceMarks>& marks() const { return marks_; }

 private:
  void mark_side(const BasisContext& context, Side side, std::uint64_t bits);
  void mark_point(const BasisContext& context, const Vec2& at, std::uint64_t bits);

  std::vector<PieceMarks> marks_;
};

}  // namespace cdca
