// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/carried_cells.hpp"

#include "core/base/marked.hpp"
#include "core/base/sort_once.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace cdca {

namespace {

bool same_zone(const TipZone& a, const TipZone& b) {
  return a.crack == b.crack && a.end == b.end && a.frame.path() == b.frame.path() &&
         a.frame.valid_radius() == b.frame.valid_radius() && a.nodes == b.nodes &&
         a.with_modes == b.with_modes && a.parts == b.parts;
}

void add_elements_of_others(const std::vector<TipZone>& zones, const std::vector<TipZone>& others,
                            std::vector<GlobalId>& elements) {
  for (const TipZone& zone : zones) {
    if (std::any_of(others.begin(), others.end(),
                    [&](const TipZone& other) { return same_zone(zone, other); }))
      continue;
    for (const auto& [id, acts] : zone.parts) elements.push_back(id);
  }
}

/// A cell has the same pieces, of the same parts, and as many near-tip unknowns.
bool same_unknowns(const SpecialCell& a, const SpecialCell& b) {
  return (a.pieces == b.pieces || *a.pieces == *b.pieces) &&
         std::equal(a.tips.begin(), a.tips.end(), b.tips.begin(), b.tips.end(),
                    [](const TipUnknowns& s, const TipUnknowns& t) { return s.count == t.count; });
}

}  // namespace

std::vector<GlobalId> changed_cuts(const ElementCuts& before, const ElementCuts& after) {
  std::vector<GlobalId> changed;
  for (const auto* cuts : {&before, &after}) {
    for (const GlobalId id : cuts->touched_elements()) {
      const GridIndex e = after.grid().element_index(id);
      if (!after.paths().same_steps(before.paths(), e)) changed.push_back(id);
    }
  }
  sort_once(changed);
  return changed;
}

std::vector<GlobalId> with_changed_zones(std::vector<GlobalId> elements,
                                         const std::vector<TipZone>& before,
                                         const std::vector<TipZone>& after) {
  add_elements_of_others(before, after, elements);
  add_elements_of_others(after, before, elements);
  sort_once(elements);
  return elements;
}

std::vector<GlobalId> with_other_sides(std::vector<GlobalId> elements, const ElementCuts& cuts) {
  if (elements.empty()) return elements;
  sort_once(elements);
  std::vector<GlobalId> all = elements;
  const StructuredGrid& grid = cuts.grid();
  for (const GlobalId id : cuts.touched_elements()) {
    for (const CrackFace& face : cuts.faces_of(grid.element_index(id))) {
      const std::array<GlobalId, 3> coupled{id, grid.element(face.plus_element),
                                            grid.element(face.minus_element)};
      const bool any = std::any_of(coupled.begin(), coupled.end(), [&](GlobalId e) {
        return std::binary_search(elements.begin(), elements.end(), e);
      });
      if (any) all.insert(all.end(), coupled.begin(), coupled.end());
    }
  }
  sort_once(all);
  return all;
}

std::vector<GlobalId> parents_of(const std::vector<GlobalId>& elements,
                                 const StructuredGrid& grid) {
  const StructuredGrid coarser = grid.coarser();
  std::vector<GlobalId> parents;
  for (const GlobalId id : elements) {
    const GridIndex e = grid.element_index(id);
    parents.push_back(coarser.element({e.i / 2, e.j / 2}));
  }
  sort_once(parents);
  return parents;
}

CarriedCells::CarriedCells(const LocalMesh& mesh, const CellUnknowns& unknowns_before,
                           const CellStiffness& before, const CellUnknowns& unknowns,
                           ChangedElements changed, const std::vector<char>& held,
                           const std::vector<double>& springs)
    : before_(before),
      changed_(std::move(changed)),
      same_rows_(std::size_t(mesh.node_count()), 1),
      same_(same_rows_),
      plain_(2 * mesh.owned_nodes()),
      now_(std::size_t(unknowns_before.count() - plain_), -1) {
  mark_changed(mesh, unknowns);
  carry_unknowns(mesh, unknowns_before, unknowns, held, springs);
  for (std::size_t n = 0; n < same_.size(); ++n) same_[n] &= same_rows_[n];
  mark_zones(unknowns);
  mark_turned(mesh);
}

void CarriedCells::differs_round(const LocalMesh& mesh, LocalId node) {
  mesh.for_nodes_round(node, [&](LocalId n) { same_rows_[std::size_t(n)] = 0; });
}

void CarriedCells::mark_changed(const LocalMesh& mesh, const CellUnknowns& unknowns) {
  for (const GlobalId id : changed_.functions) {
    for (const GridIndex corner : mesh.grid().corners(mesh.grid().element_index(id))) {
      const LocalId n = mesh.find_node(corner);
      if (n < 0) continue;
      same_rows_[std::size_t(n)] = 0;
      // on which side of the crack its near-tip functions are seen may show in all of its elements
      if (!unknowns.tips(n).empty()) differs_round(mesh, n);
    }
  }
}

void CarriedCells::mark_turned(const LocalMesh& mesh) {
  for (const GlobalId id : changed_.turned) {
    for (const LocalId n : mesh.element_nodes(mesh.grid().element_index(id))) {
      if (n >= 0) same_[std::size_t(n)] = 0;
    }
  }
}

void CarriedCells::carry_plain(const LocalMesh& mesh, const CellUnknowns& unknowns_before,
                               const CellUnknowns& unknowns, const std::vector<char>& held,
                               const std::vector<double>& springs) {
  // nothing holds ghosts or pulls at them here
  if (const LocalId ghost = mesh.owned_nodes(); ghost < mesh.node_count()) {
    const auto first = now_.begin() + (unknowns_before.of_piece(ghost, 0) - plain_);
    std::iota(first, first + 2 * (mesh.node_count() - ghost), unknowns.of_piece(ghost, 0));
  }
  const auto is_held = marked({held.data(), std::size_t(plain_)});
  std::vector<LocalId> others;
  const auto& was_held = before_.held();
  std::set_symmetric_difference(was_held.begin(),
                                std::lower_bound(was_held.begin(), was_held.end(), plain_),
                                is_held.begin(), is_held.end(), std::back_inserter(others));
  for (const LocalId u : others) differs_round(mesh, u / 2);
  std::vector<std::pair<LocalId, double>> was, is, other_springs;
  for (const CellStiffness::Spring& s : before_.springs()) {
    if (s.unknown < plain_) was.emplace_back(s.unknown, s.share);
  }
  for (LocalId u = 0; !springs.empty() && u < plain_; ++u) {
    if (springs[std::size_t(u)] != 0.0) is.emplace_back(u, springs[std::size_t(u)]);
  }
  std::set_symmetric_difference(was.begin(), was.end(), is.begin(), is.end(),
                                std::back_inserter(other_springs));
  for (const auto& [u, share] : other_springs) same_[std::size_t(u / 2)] = 0;
}

void CarriedCells::carry_unknowns(const LocalMesh& mesh, const CellUnknowns& unknowns_before,
                                  const CellUnknowns& unknowns, const std::vector<char>& held,
                                  const std::vector<double>& springs) {
  carry_plain(mesh, unknowns_before, unknowns, held, springs);
  std::vector<char> was_held(now_.size(), 0);
  std::vector<double> share_before(now_.size(), 0.0);
  for (const LocalId u : before_.held()) {
    if (u >= plain_) was_held[std::size_t(u - plain_)] = 1;
  }
  for (const CellStiffness::Spring& s : before_.springs()) {
    if (s.unknown >= plain_) share_before[std::size_t(s.unknown - plain_)] = s.share;
  }
  const auto carry = [&](LocalId n, LocalId from, LocalId to, LocalId count) {
    bool alike = true;
    for (LocalId k = 0; k < count; ++k) {
      const auto u = std::size_t(from + k - plain_), v = std::size_t(to + k);
      now_[u] = to + k;
      alike = alike && was_held[u] == held[v];
      if (share_before[u] != (springs.empty() ? 0.0 : springs[v])) same_[std::size_t(n)] = 0;
    }
    return alike;
  };
  for (const LocalId n : unknowns_before.special_nodes()) {
    const SpecialCell &was = *unknowns_before.special(n), *is = unknowns.special(n);
    if (!is || !same_unknowns(was, *is)) {
      differs_round(mesh, n);
      continue;
    }
    bool alike = carry(n, was.extra, is->extra, 2 * (was.pieces->count - 1));
    for (std::size_t k = 0; k < was.tips.size(); ++k)
      alike = carry(n, was.tips[k].first, is->tips[k].first, was.tips[k].count) && alike;
    if (!alike) differs_round(mesh, n);
  }
  for (const LocalId n : unknowns.special_nodes()) {
    if (!unknowns_before.special(n)) differs_round(mesh, n);
  }
}

void CarriedCells::mark_zones(const CellUnknowns& unknowns) {
  // functions that strain nothing are held zone by zone
  std::map<int, std::vector<LocalId>> zones;
  for (const LocalId n : unknowns.special_nodes()) {
    for (const TipUnknowns& tip : unknowns.tips(n)) zones[tip.zone].push_back(n);
  }
  // cells of two zones pass it on
  for (bool found = true; found;) {
    found = false;
    for (const auto& [number, nodes] : zones) {
      const auto kept = std::count_if(nodes.begin(), nodes.end(),
                                      [&](LocalId n) { return same_[std::size_t(n)] != 0; });
      if (kept == 0 || kept == std::ptrdiff_t(nodes.size())) continue;
      for (const LocalId n : nodes) same_[std::size_t(n)] = 0;
      found = true;
    }
  }
}

}  // namespace cdca
