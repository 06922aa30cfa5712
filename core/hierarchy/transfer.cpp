// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/transfer.hpp"

#include <algorithm>

namespace cdca {

namespace {

std::vector<char> plain_cells(const LocalMesh& mesh, const CellUnknowns& unknowns) {
  std::vector<char> plain(std::size_t(mesh.node_count()), 1);
  for (const LocalId n : unknowns.special_nodes()) plain[std::size_t(n)] = 0;
  return plain;
}

}  // namespace

Transfer::Transfer(const Scale& fine, const LocalMesh& coarse, const CellUnknowns& unknowns,
                   const CoarseParts& parts) {
  std::vector<LocalId> others;
  find_runs(fine.mesh, coarse, plain_cells(fine.mesh, fine.unknowns), plain_cells(coarse, unknowns),
            others);
  for (const LocalId n : others) add_entries(fine, n, coarse, unknowns, parts);
}

void Transfer::find_runs(const LocalMesh& fine, const LocalMesh& coarse,
                         const std::vector<char>& plain_fine, const std::vector<char>& plain_coarse,
                         std::vector<LocalId>& others) {
  // runs address own coarse cells only: those of ghosts are numbered apart
  const auto usable = [&](LocalId c, GridIndex at) {
    return c >= 0 && c < coarse.owned_nodes() && plain_coarse[std::size_t(c)] &&
           coarse.node(c) == at;
  };
  for (LocalId n = 0; n < fine.owned_nodes(); ++n) {
    const GridIndex at = fine.node(n);
    const int left = at.i / 2, right = (at.i + 1) / 2, low = at.j / 2, high = (at.j + 1) / 2;
    if (!plain_fine[std::size_t(n)]) {
      others.push_back(n);
      continue;
    }
    if (!runs_.empty()) {
      Run& run = runs_.back();
      const bool follows =
          run.fine + run.count == n && fine.node(n - 1) == GridIndex{at.i - 1, at.j};
      const LocalId ahead = right - fine.node(run.fine).i / 2;
      if (follows && usable(run.below + ahead, {right, low}) &&
          usable(run.above + ahead, {right, high})) {
        ++run.count;
        continue;
      }
    }
    const LocalId below = coarse.find_node({left, low}), above = coarse.find_node({left, high});
    const LocalId ahead = right - left;
    if (usable(below, {left, low}) && usable(above, {left, high}) &&
        usable(below + ahead, {right, low}) && usable(above + ahead, {right, high})) {
      runs_.push_back({n, 1, at.i % 2 == 1, below, above});
    } else {
      others.push_back(n);
    }
  }
}

void Transfer::add_entries(const Scale& fine, LocalId node, const LocalMesh& coarse,
                           const CellUnknowns& unknowns, const CoarseParts& parts) {
  const GridIndex at = fine.mesh.node(node);
  const auto elements = fine.mesh.grid().elements_round(at);
  std::vector<char> done(std::size_t(fine.unknowns.pieces(node)), 0);
  for (std::size_t slot = 0; slot < 4; ++slot) {
    const GridIndex e = elements[slot];
    if (!fine.mesh.grid().has_element(e)) continue;
    for (int part = 0; part < fine.parts.parts(e); ++part) {
      const int piece = fine.unknowns.piece(node, slot, part);
      if (done[std::size_t(piece)]) continue;
      done[std::size_t(piece)] = 1;
      // a fine piece lies in one part of the coarse element, whichever of its own parts is asked
      const GridIndex parent{e.i / 2, e.j / 2};
      const int coarse_part = parts.part_of(e, part);
      const GridIndex corners[4] = {{parent.i, parent.j},
                                    {parent.i + 1, parent.j},
                                    {parent.i + 1, parent.j + 1},
                                    {parent.i, parent.j + 1}};
      for (std::size_t a = 0; a < 4; ++a) {
        const double weight = (1 - 0.5 * std::abs(at.i - 2 * corners[a].i)) *
                              (1 - 0.5 * std::abs(at.j - 2 * corners[a].j));
        if (weight <= 0.0) continue;
        const LocalId c = coarse.find_node(corners[a]);
        entries_.push_back({fine.unknowns.of_piece(node, piece),
                            unknowns.of_piece(c, unknowns.piece(c, (a + 2) % 4, coarse_part)),
                            weight});
      }
    }
  }
}

void Transfer::to_coarse(std::span<const double> fine, const Halo& halo,
                         std::span<double> coarse) const {
  std::fill(coarse.begin(), coarse.end(), 0.0);
  for (const Run& run : runs_) {
    const double* f = &fine[2 * std::size_t(run.fine)];
    const double share = run.above == run.below ? 1.0 : 0.5;
    double* below = &coarse[2 * std::size_t(run.below)];
    double* above = &coarse[2 * std::size_t(run.above)];
    LocalId k = 0, c = 0;
    const auto add = [&](LocalId at, double weight, const double* value) {
      for (std::size_t d = 0; d < 2; ++d) {
        below[2 * std::size_t(at) + d] += weight * value[d];
        if (share < 1.0) above[2 * std::size_t(at) + d] += weight * value[d];
      }
    };
    if (run.odd) {
      add(0, 0.5 * share, f);
      add(1, 0.5 * share, f);
      k = c = 1;
    }
    for (; k < run.count; k += 2, ++c) {
      add(c, share, f + 2 * k);
      if (k + 1 >= run.count) break;
      add(c, 0.5 * share, f + 2 * k + 2);
      add(c + 1, 0.5 * share, f + 2 * k + 2);
    }
  }
  for (const Entry& e : entries_) {
    coarse[std::size_t(e.coarse)] += e.weight * fine[std::size_t(e.fine)];
    coarse[std::size_t(e.coarse) + 1] += e.weight * fine[std::size_t(e.fine) + 1];
  }
  halo.add_forces(coarse);
}

void Transfer::add_to_fine(std::span<double> coarse, const Halo& halo,
                           std::span<double> fine) const {
  halo.copy_state(coarse);
  for (const Run& run : runs_) {
    double* f = &fine[2 * std::size_t(run.fine)];
    const double share = run.above == run.below ? 1.0 : 0.5;
    const double* below = &coarse[2 * std::size_t(run.below)];
    const double* above = &coarse[2 * std::size_t(run.above)];
    const auto value = [&](LocalId at, std::size_t d) {
      const double v = below[2 * std::size_t(at) + d];
      return share < 1.0 ? 0.5 * (v + above[2 * std::size_t(at) + d]) : v;
    };
    LocalId k = 0, c = 0;
    if (run.odd) {
      for (std::size_t d = 0; d < 2; ++d) f[d] += 0.5 * (value(0, d) + value(1, d));
      k = c = 1;
    }
    for (; k < run.count; k += 2, ++c) {
      for (std::size_t d = 0; d < 2; ++d) f[2 * std::size_t(k) + d] += value(c, d);
      if (k + 1 >= run.count) break;
      for (std::size_t d = 0; d < 2; ++d)
        f[2 * std::size_t(k) + 2 + d] += 0.5 * (value(c, d) + value(c + 1, d));
    }
  }
  for (const Entry& e : entries_) {
    fine[std::size_t(e.fine)] += e.weight * coarse[std::size_t(e.coarse)];
    fine[std::size_t(e.fine) + 1] += e.weight * coarse[std::size_t(e.coarse) + 1];
  }
}

}  // namespace cdca
