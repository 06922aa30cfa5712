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

/// The field of a tip on the way from one set of cracks to another.
struct CarriedTip {
  const TipZone *was, *is;
  const TipUnknowns *from, *to;
  TipField field;
};

/// Tips that go on to serve the cell, in the same proportions.
std::vector<CarriedTip> carried_tips(const BasisContext& before, const std::vector<double>& state,
                                     const BasisContext& after, LocalId node) {
  std::vector<CarriedTip> tips;
  for (const TipUnknowns& tip : after.unknowns.tips(node)) {
    const TipZone& zone = after.zones[std::size_t(tip.zone)];
    const TipUnknowns* old = same_tip(before, node, zone);
    if (!old || old->count != tip.count) continue;
    const TipZone& old_zone = before.zones[std::size_t(old->zone)];
    tips.push_back({&old_zone, &zone, old, &tip, field_of(*old, old_zone, state)});
  }
  return tips;
}

/// By how much the functions are shifted otherwise at a node than they were: a piece moves by that
/// lest the field there changes.
Vec2 shift_of(const std::vector<CarriedTip>& tips, const BasisContext& before, int old_piece,
              const BasisContext& after, int piece, LocalId node) {
  Vec2 shift(0, 0);
  for (const CarriedTip& tip : tips) {
    const auto was = tip_at_node(before, *tip.was, node, old_piece).values;
    const auto is = tip_at_node(after, *tip.is, node, piece).values;
    for (std::size_t l = 0; l < 4; ++l)
      shift += (is[l] - was[l]) * tip.field.row(Eigen::Index(l)).transpose();
  }
  return shift;
}

}  // namespace

std::vector<double> carried_state(const BasisContext& before, std::vector<double> old_state,
                                  const BasisContext& after) {
  std::vector<std::pair<LocalId, double>> special;
  const auto put = [&special](LocalId first, const Vec2& values) {
    special.emplace_back(first, values.x());
    special.emplace_back(first + 1, values.y());
  };
  for (const LocalId n : after.unknowns.special_nodes()) {
    if (!after.mesh.owns(n)) break;
    const auto tips = carried_tips(before, old_state, after, n);
    for (const CarriedTip& tip : tips) {
      if (tip.to->has_modes()) {
        const auto modes = std::size_t(tip.from->first);
        put(tip.to->first, {old_state[modes], old_state[modes + 1]});
        continue;
      }
      const TipField values = tip.to->functions.partialPivLu().solve(tip.field);
      for (Eigen::Index l = 0; l < 4; ++l)
        put(tip.to->first + 2 * LocalId(l), values.row(l).transpose());
    }
    for (int p = 0; p < after.unknowns.pieces(n); ++p) {
      const int old = old_piece_of(before, after, n, p);
      const Vec2 shift = shift_of(tips, before, old, after, p, n);
      const auto from = std::size_t(before.unknowns.of_piece(n, old));
      put(after.unknowns.of_piece(n, p), Vec2(old_state[from], old_state[from + 1]) + shift);
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
