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

/// Coefficients of the four functions of Eq. 5, x and y: what a tip adds to its cell.
using TipField = Eigen::Matrix<double, 4, 2>;

TipField field_of(const TipUnknowns& tip, const TipZone& zone, const std::vector<double>& state) {
  const auto first = std::size_t(tip.first);
  TipField field;
  if (tip.has_modes()) {
    const Vec2 modes(state[first], state[first + 1]);
    for (Eigen::Index l = 0; l < 4; ++l)
      field.row(l) = (zone.modes[std::size_t(l)] * modes).transpose();
    return field;
  }
  for (Eigen::Index l = 0; l < 4; ++l)
    field.row(l) << state[first + std::size_t(2 * l)], state[first + std::size_t(2 * l + 1)];
  return tip.functions * field;
}

/// The unknowns of a tip on the way from one set of cracks to another.
struct CarriedTip {
  const TipZone *was, *is;
  TipField field;
};

/// By how much the functions are shifted otherwise at a node than they were: a piece moves by that
/// lest the field there changes.
Vec2 shift_of(const std::vector<CarriedTip>& tips, const BasisContext& before, int old_piece,
              const BasisContext& after, int piece, LocalId node) {
  Vec2 shift(0, 0);
  for (const CarriedTip& tip : tips) {
    const auto was = tip_values_at_node(before, *tip.was, node, old_piece);
    const auto is = tip_values_at_node(after, *tip.is, node, piece);
    for (std::size_t l = 0; l < 4; ++l)
      shift += (is[l] - was[l]) * tip.field.row(Eigen::Index(l)).transpose();
  }
  return shift;
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
    std::vector<CarriedTip> tips;
    for (const TipUnknowns& tip : after.unknowns.tips(n)) {
      const TipZone& zone = after.zones[std::size_t(tip.zone)];
      const TipUnknowns* old = same_tip(before, n, zone);
      if (!old || old->count != tip.count) continue;
      const TipZone& old_zone = before.zones[std::size_t(old->zone)];
      tips.push_back({&old_zone, &zone, field_of(*old, old_zone, old_state)});
      if (tip.has_modes()) {
        carry(old->first, tip.first, 2);
        continue;
      }
      const TipField values = tip.functions.partialPivLu().solve(tips.back().field);
      for (LocalId l = 0; l < 4; ++l) {
        special.emplace_back(tip.first + 2 * l, values(l, 0));
        special.emplace_back(tip.first + 2 * l + 1, values(l, 1));
      }
    }
    for (int p = 0; p < after.unknowns.pieces(n); ++p) {
      const int old = old_piece_of(before, after, n, p);
      const Vec2 shift = shift_of(tips, before, old, after, p, n);
      const auto from = std::size_t(before.unknowns.of_piece(n, old));
      const LocalId to = after.unknowns.of_piece(n, p);
      special.emplace_back(to, old_state[from] + shift.x());
      special.emplace_back(to + 1, old_state[from + 1] + shift.y());
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
