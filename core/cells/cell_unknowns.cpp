// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/cell_unknowns.hpp"

#include "core/base/marked.hpp"
#include "core/cells/tip_functions.hpp"

#include <algorithm>
#include <unordered_map>

namespace cdca {

namespace {

/// A special cell as a line of numbers: node, pieces, parts and pieces of each slot, tips.
void write_cell(GlobalId node, const SpecialCell& cell, std::vector<std::int64_t>& out) {
  out.push_back(node);
  out.push_back(cell.pieces->count);
  for (const auto& slot : cell.pieces->piece) {
    out.push_back(std::int64_t(slot.size()));
    out.insert(out.end(), slot.begin(), slot.end());
  }
  out.push_back(std::int64_t(cell.tips.size()));
  for (const TipUnknowns& tip : cell.tips) out.insert(out.end(), {tip.zone, tip.count});
}

std::pair<GlobalId, SpecialCell> read_cell(const std::vector<std::int64_t>& in, std::size_t& at) {
  const GlobalId node = in[at++];
  CellPieces pieces;
  pieces.count = int(in[at++]);
  for (auto& slot : pieces.piece) {
    const auto parts = std::size_t(in[at++]);
    for (std::size_t k = 0; k < parts; ++k) slot.push_back(int(in[at++]));
  }
  SpecialCell cell;
  cell.pieces = std::make_shared<const CellPieces>(std::move(pieces));
  const auto tips = std::size_t(in[at++]);
  for (std::size_t k = 0; k < tips; ++k, at += 2)
    cell.tips.push_back({int(in[at]), 0, LocalId(in[at + 1]), {}});
  return {node, std::move(cell)};
}

}  // namespace

CellUnknowns::CellUnknowns(const LocalMesh& mesh, const ElementParts& elements,
                           const std::vector<TipZone>& zones, Communicator& communicator,
                           const Kept* kept)
    : owned_nodes_(mesh.owned_nodes()) {
  Cells cells = find_own(mesh, elements, zones, kept);
  add_ghosts(mesh, communicator, cells);
  number(mesh, std::move(cells));
  make_tip_functions(mesh, zones);
}

void CellUnknowns::make_tip_functions(const LocalMesh& mesh, const std::vector<TipZone>& zones) {
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    for (TipUnknowns& tip : cells_[k].tips) {
      if (tip.has_modes()) continue;
      tip.functions = orthonormal_tip_functions(mesh.grid(), mesh.node(special_nodes_[k]),
                                                zones[std::size_t(tip.zone)].frame);
    }
  }
}

CellUnknowns::Cells CellUnknowns::find_own(const LocalMesh& mesh, const ElementParts& elements,
                                           const std::vector<TipZone>& zones, const Kept* kept) {
  const StructuredGrid& grid = mesh.grid();
  std::vector<char> candidates(std::size_t(mesh.owned_nodes()), 0), changed(candidates);
  const auto mark_corners = [&](const std::vector<GlobalId>& ids, std::vector<char>& flags) {
    for (const GlobalId id : ids) {
      const GridIndex e = grid.element_index(id);
      if (mesh.find_element(e) < 0) continue;
      for (const LocalId n : mesh.element_nodes(e)) {
        if (mesh.owns(n)) flags[std::size_t(n)] = 1;
      }
    }
  };
  mark_corners(elements.touched_elements(), candidates);
  if (kept) mark_corners(kept->changed, changed);
  std::unordered_map<LocalId, std::vector<TipUnknowns>> tips;
  for (std::size_t z = 0; z < zones.size(); ++z) {
    for (const GlobalId id : zones[z].nodes) {
      const LocalId n = mesh.find_node(grid.node_index(id));
      if (n < 0 || !mesh.owns(n)) continue;
      candidates[std::size_t(n)] = 1;
      tips[n].push_back({int(z), 0, zones[z].with_modes.count(id) ? 2 : 8, {}});
    }
  }
  Cells cells;
  for (const LocalId n : marked(candidates)) {
    SpecialCell cell;
    if (const auto of_node = tips.find(n); of_node != tips.end())
      cell.tips = std::move(of_node->second);
    const bool same = kept && !changed[std::size_t(n)];
    const SpecialCell* was = same ? kept->before.special(n) : nullptr;
    if (was) cell.pieces = was->pieces;
    if (same && !was && cell.tips.empty()) continue;
    if (!was) cell.pieces = std::make_shared<const CellPieces>(pieces_of(elements, mesh.node(n)));
    if (cell.pieces->count > 1 || !cell.tips.empty()) cells.emplace_back(n, std::move(cell));
  }
  return cells;
}

void CellUnknowns::add_ghosts(const LocalMesh& mesh, Communicator& communicator, Cells& cells) {
  const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::vector<int> ranks;
  std::vector<Bytes> outgoing;
  for (const SharedNodes& shared : mesh.shared()) {
    std::vector<std::int64_t> lines;
    for (const LocalId n : shared.owned) {
      const auto at =
          std::lower_bound(cells.begin(), cells.end(), std::pair(n, SpecialCell()), before);
      if (at != cells.end() && at->first == n) write_cell(mesh.node_id(n), at->second, lines);
    }
    ranks.push_back(shared.rank);
    outgoing.emplace_back();
    pack(outgoing.back(), std::span<const std::int64_t>(lines));
  }
  const auto own = std::ptrdiff_t(cells.size());
  for (const Bytes& bytes : communicator.exchange(ranks, outgoing)) {
    const auto lines = unpack<std::int64_t>(bytes);
    for (std::size_t at = 0; at < lines.size();) {
      auto [id, cell] = read_cell(lines, at);
      cells.emplace_back(mesh.find_node(mesh.grid().node_index(id)), std::move(cell));
    }
  }
  std::sort(cells.begin() + own, cells.end(), before);
}

void CellUnknowns::number(const LocalMesh& mesh, Cells cells) {
  place_.assign(std::size_t(mesh.node_count()), -1);
  for (auto& [n, cell] : cells) {
    place_[std::size_t(n)] = LocalId(cells_.size());
    special_nodes_.push_back(n);
    cells_.push_back(std::move(cell));
  }
  // own nodes come first, ghosts after them
  LocalId next = 2 * owned_nodes_;
  const auto number_extras = [&](SpecialCell& cell) {
    cell.extra = next;
    next += 2 * (cell.pieces->count - 1);
    for (TipUnknowns& tip : cell.tips) {
      tip.first = next;
      next += tip.count;
    }
  };
  std::size_t k = 0;
  for (; k < cells_.size() && mesh.owns(special_nodes_[k]); ++k) number_extras(cells_[k]);
  owned_ = ghost_start_ = next;
  next += 2 * (mesh.node_count() - owned_nodes_);
  for (; k < cells_.size(); ++k) number_extras(cells_[k]);
  count_ = next;
}

LocalId CellUnknowns::of_piece(LocalId node, int piece) const {
  if (piece > 0) return special(node)->extra + 2 * (piece - 1);
  return node < owned_nodes_ ? 2 * node : ghost_start_ + 2 * (node - owned_nodes_);
}

std::vector<LocalId> CellUnknowns::of_cell(LocalId node) const {
  std::vector<LocalId> unknowns;
  append_cell(node, unknowns);
  return unknowns;
}

void CellUnknowns::append_cell(LocalId node, std::vector<LocalId>& unknowns) const {
  const auto append = [&](LocalId first, LocalId count) {
    for (LocalId k = 0; k < count; ++k) unknowns.push_back(first + k);
  };
  append(of_piece(node, 0), 2);
  const SpecialCell* cell = special(node);
  if (!cell) return;
  append(cell->extra, 2 * (cell->pieces->count - 1));
  for (const TipUnknowns& tip : cell->tips) append(tip.first, tip.count);
}

int CellUnknowns::piece(LocalId node, std::size_t slot, int part) const {
  const SpecialCell* cell = special(node);
  return cell ? cell->pieces->piece[slot][std::size_t(part)] : 0;
}

int CellUnknowns::pieces(LocalId node) const {
  const SpecialCell* cell = special(node);
  return cell ? cell->pieces->count : 1;
}

std::span<const TipUnknowns> CellUnknowns::tips(LocalId node) const {
  const SpecialCell* cell = special(node);
  return cell ? std::span<const TipUnknowns>(cell->tips) : std::span<const TipUnknowns>();
}

std::vector<SharedUnknowns> CellUnknowns::shared(const LocalMesh& mesh) const {
  std::vector<SharedUnknowns> lists;
  for (const SharedNodes& nodes : mesh.shared()) {
    SharedUnknowns shared;
    shared.rank = nodes.rank;
    for (const LocalId n : nodes.owned) append_cell(n, shared.owned);
    for (const LocalId n : nodes.ghosts) append_cell(n, shared.ghosts);
    lists.push_back(std::move(shared));
  }
  return lists;
}

}  // namespace cdca
