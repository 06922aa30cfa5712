// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/state_transfer.hpp"

#include <algorithm>
#include <utility>

namespace cdca {

namespace {

/// The old piece where a new one has its first part.
int old_piece_of(const BasisContext& before, const BasisContext& after, LocalId node, int piece) {
  const SpecialCell* was = before.unknowns.special(node);
  const CellPieces& pieces = *after.unknowns.special(node)->pieces;
  if (was && was->pieces.get() == &pieces) return piece;  // nothing has changed round the cell
  const auto elements = after.mesh.grid().elements_round(after.mesh.node(node));
  for (std::size_t slot = 0; slot < 4; ++slot) {
    const auto& parts = pieces.piece[slot];
    const auto it = std::find(parts.begin(), parts.end(), piece);
    if (it == parts.end()) continue;
    const GridIndex e = elements[slot];
    const CutElement* cut = after.cuts.find(e);
    const Vec2 inside = cut ? cut->place_in(int(it - parts.begin())) : Vec2(0.5, 0.5);
    const int old_part = before.cuts.part_at(e, Vec2(e.i, e.j) + inside);
    return before.unknowns.piece(node, slot, old_part);
  }
  return 0;
}

/// Of a tip that has hardly moved, as from one trial to the next, the field moves along.
const TipUnknowns* same_tip(const BasisContext& before, LocalId node, const TipZone& zone) {
  constexpr double near = 0.25;  // elements
  const double size = before.mesh.grid().smallest_side();
  for (const TipUnknowns& tip : before.unknowns.tips(node)) {
    const TipZone& old = before.zones[std::size_t(tip.zone)];
    if (old.crack != zone.crack || old.end != zone.end) continue;
    if ((old.frame.tip() - zone.frame.tip()).norm() <= near * size) return &tip;
  }
  return nullptr;
}

}  // namespace

std::vector<double> carried_state(const BasisContext& before, std::vector<double> old_state,
                                  const BasisContext& after) {
  std::vector<std::pair<LocalId, double>> special;
  const auto carry = [&](LocalId from, LocalId to, LocalId count) {
    for (LocalId k = 0; k < count; ++k)
      special.emplace_back(to + k, old_state[std::size_t(from + k)]);
  };
  for (const LocalId n : after.unknowns.special_nodes()) {
    if (!after.mesh.owns(n)) break;
    for (int p = 0; p < after.unknowns.pieces(n); ++p) {
      const int old = old_piece_of(before, after, n, p);
      carry(before.unknowns.of_piece(n, old), after.unknowns.of_piece(n, p), 2);
    }
    for (const TipUnknowns& tip : after.unknowns.tips(n)) {
      const TipUnknowns* old = same_tip(before, n, after.zones[std::size_t(tip.zone)]);
      if (old && old->count == tip.count) carry(old->first, tip.first, tip.count);
    }
  }
  // most cells are plain, and have their two unknowns at the same place
  std::vector<double> state = std::move(old_state);
  state.resize(std::size_t(2 * after.mesh.owned_nodes()));
  state.resize(std::size_t(after.unknowns.count()), 0.0);
  for (const auto& [u, value] : special) state[std::size_t(u)] = value;
  return state;
}

}  // namespace cdca
