// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/loaded_pieces.hpp"

#include "core/mechanics/side_walk.hpp"

#include <bit>

namespace cdca {

namespace {

bool any(const LoadVector& load) { return load[0].has_value() || load[1].has_value(); }

/// A plain zero says that a side is free.
bool acts(const LoadVector& load) {
  const auto is_zero = [](const LoadValue& v) {
    return v.proportional && v.at(0.381966, 0.723607, 1) == 0.0;
  };
  return (load[0] && !is_zero(*load[0])) || (load[1] && !is_zero(*load[1]));
}

}  // namespace

LoadedPieces::LoadedPieces(const BasisContext& context, const std::vector<BoundarySpec>& blocks) {
  std::uint64_t sides = 0;
  for (const BoundarySpec& b : blocks) {
    if (b.kind != BoundaryKind::side || (!any(b.displacement) && !acts(b.traction))) continue;
    const std::uint64_t bit = std::uint64_t(1) << int(b.side);
    sides |= bit;
    mark_side(context, b.side, bit | (acts(b.traction) ? forces : 0));
  }
  const bool sides_alone = std::popcount(sides) > 1;
  std::uint64_t bit = 16;
  for (const BoundarySpec& b : blocks) {
    if (b.kind != BoundaryKind::point) continue;
    if (acts(b.force)) mark_point(context, b.at, forces);
    if (sides_alone || bit == 0) continue;
    mark_point(context, b.at, bit);
    bit = bit == forces / 2 ? 2 * forces : 2 * bit;
  }
}

void LoadedPieces::mark_side(const BasisContext& c, Side side, std::uint64_t bits) {
  const SideGeometry geometry = geometry_of(side);
  for (const GridIndex e : elements_at(c.mesh, side)) {
    const auto nodes = c.mesh.element_nodes(e);
    for (const SidePortion& portion : c.cuts.side(e, geometry.element_side)) {
      if (portion.closed) continue;
      for (const std::size_t corner : {geometry.first_corner, geometry.last_corner}) {
        const int piece = c.unknowns.piece(nodes[corner], (corner + 2) % 4, portion.part);
        marks_.push_back({nodes[corner], piece, bits});
      }
    }
  }
}

void LoadedPieces::mark_point(const BasisContext& c, const Vec2& x, std::uint64_t bits) {
  const Vec2 at = c.mesh.grid().to_grid(x);
  const GridIndex e = c.mesh.grid().element_at(at);
  if (c.mesh.find_element(e) < 0) return;
  const auto nodes = c.mesh.element_nodes(e);
  const int part = c.cuts.part_at(e, at);
  for (std::size_t a = 0; a < 4; ++a) {
    marks_.push_back({nodes[a], c.unknowns.piece(nodes[a], (a + 2) % 4, part), bits});
  }
}

}  // namespace cdca
