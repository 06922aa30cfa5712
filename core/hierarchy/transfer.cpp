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

void Transfer::gather_row(const Run& run, double share, const double* fine, double* coarse) {
  const auto count = 2 * std::ptrdiff_t(run.count);
  Pair half = Pair::Zero();  // of the fine cell on the left
  std::ptrdiff_t k = 0, c = 0;
  if (run.odd) {
    half = 0.5 * ConstPlace(fine);
    Place(coarse) += share * half;
    k = c = 2;
  }
  for (; k + 2 < count; k += 4, c += 2) {
    const Pair next = 0.5 * ConstPlace(fine + k + 2);
    Place(coarse + c) += share * (half + ConstPlace(fine + k) + next);
    half = next;
  }
  if (k < count) half += ConstPlace(fine + k);
  Place(coarse + c) += share * half;
}

void Transfer::to_coarse(std::span<const double> fine, const Halo& halo,
                         std::span<double> coarse) const {
  std::fill(coarse.begin(), coarse.end(), 0.0);
  for (const Run& run : runs_) {
    const double* f = fine.data() + 2 * std::ptrdiff_t(run.fine);
    const bool between = run.above != run.below;
    gather_row(run, between ? 0.5 : 1.0, f, coarse.data() + 2 * std::ptrdiff_t(run.below));
    if (between) gather_row(run, 0.5, f, coarse.data() + 2 * std::ptrdiff_t(run.above));
  }
  for (const Entry& e : entries_) {
    coarse[std::size_t(e.coarse)] += e.weight * fine[std::size_t(e.fine)];
    coarse[std::size_t(e.coarse) + 1] += e.weight * fine[std::size_t(e.fine) + 1];
  }
  halo.add_forces(coarse);
}

/// coarse(c): the displacement at column c of coarse cells, at the height of the fine row.
template <class Coarse>
void Transfer::spread_row(const Run& run, const Coarse& coarse, double* fine) {
  const auto count = 2 * std::ptrdiff_t(run.count);
  std::ptrdiff_t k = 0, c = 0;
  Pair here = coarse(0);
  if (run.odd) {
    const Pair next = coarse(2);
    Place(fine) += 0.5 * (here + next);
    here = next;
    k = c = 2;
  }
  for (; k + 2 < count; k += 4, c += 2) {
    const Pair next = coarse(c + 2);
    Place(fine + k) += here;
    Place(fine + k + 2) += 0.5 * (here + next);
    here = next;
  }
  if (k < count) Place(fine + k) += here;
}

void Transfer::add_to_fine(std::span<double> coarse, const Halo& halo,
                           std::span<double> fine) const {
  halo.copy_state(coarse);
  for (const Run& run : runs_) {
    double* f = fine.data() + 2 * std::ptrdiff_t(run.fine);
    const double* below = coarse.data() + 2 * std::ptrdiff_t(run.below);
    const double* above = coarse.data() + 2 * std::ptrdiff_t(run.above);
    if (run.above == run.below) {
      spread_row(
          run, [=](std::ptrdiff_t c) { return Pair(ConstPlace(below + c)); }, f);
    } else {
      spread_row(
          run,
          [=](std::ptrdiff_t c) {
            return Pair(0.5 * (ConstPlace(below + c) + ConstPlace(above + c)));
          },
          f);
    }
  }
  for (const Entry& e : entries_) {
    fine[std::size_t(e.fine)] += e.weight * coarse[std::size_t(e.coarse)];
    fine[std::size_t(e.fine) + 1] += e.weight * coarse[std::size_t(e.coarse) + 1];
  }
}

}  // namespace cdca
