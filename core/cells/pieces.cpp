// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/pieces.hpp"

#include <numeric>

namespace cdca {

namespace {

/// The four element edges that meet in the node, as (slot, its side, next slot, its side).
struct Spoke {
  std::size_t slot, side, next, next_side;
};
constexpr Spoke spokes[4] = {{0, 1, 1, 3}, {1, 2, 2, 0}, {3, 1, 2, 3}, {0, 2, 3, 0}};

}  // namespace

CellPieces pieces_of(const ElementParts& cuts, GridIndex node) {
  const StructuredGrid& grid = cuts.grid();
  const auto elements = grid.elements_round(node);
  std::array<int, 5> first{0, 0, 0, 0, 0};
  for (std::size_t s = 0; s < 4; ++s) {
    first[s + 1] = first[s] + (grid.has_element(elements[s]) ? cuts.parts(elements[s]) : 0);
  }
  std::vector<int> root(static_cast<std::size_t>(first[4]));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int k) {
    while (root[std::size_t(k)] != k) k = root[std::size_t(k)];
    return k;
  };
  for (const Spoke& spoke : spokes) {
    const GridIndex a = elements[spoke.slot], b = elements[spoke.next];
    if (!grid.has_element(a) || !grid.has_element(b)) continue;
    for (const SideContact& c : contacts(cuts.side(a, spoke.side), cuts.side(b, spoke.next_side))) {
      if (!c.open) continue;
      const int k = find(first[spoke.slot] + c.first), l = find(first[spoke.next] + c.second);
      root[std::size_t(std::max(k, l))] = std::min(k, l);
    }
  }
  CellPieces pieces;
  pieces.count = 0;
  std::vector<int> name(root.size(), -1);
  for (std::size_t s = 0; s < 4; ++s) {
    for (int k = first[s]; k < first[s + 1]; ++k) {
      int& given = name[std::size_t(find(k))];
      if (given < 0) given = pieces.count++;
      pieces.piece[s].push_back(given);
    }
  }
  return pieces;
}

}  // namespace cdca
