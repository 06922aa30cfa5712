// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/transfer.hpp"

#include <algorithm>

namespace cdca {

namespace {

std::vector<NodeRun> plain_runs(const LocalMesh& mesh, const CellUnknowns& unknowns) {
  return runs_without(mesh.own_runs(), unknowns.special_nodes());
}

/// The runs of each row, from left to right.
class RunsByRow {
 public:
  explicit RunsByRow(const std::vector<NodeRun>& runs) : runs_(runs) {
    for (std::size_t k = 0; k < runs.size(); ++k) {
      // own nodes are in order of rows
      while (start_.size() <= std::size_t(runs[k].at.j)) start_.push_back(k);
    }
    start_.push_back(runs.size());
  }
  std::span<const NodeRun> in(int row) const {
    if (std::size_t(row) + 1 >= start_.size()) return {};
    return std::span(runs_).subspan(start_[std::size_t(row)],
                                    start_[std::size_t(row) + 1] - start_[std::size_t(row)]);
  }

 private:
  const std::vector<NodeRun>& runs_;
  std::vector<std::size_t> start_;
};

}  // namespace

Transfer::Transfer(const Scale& fine, const LocalMesh& coarse, const CellUnknowns& unknowns,
                   const CoarseParts& parts) {
  const auto others =
      find_runs(fine.mesh, plain_runs(fine.mesh, fine.unknowns), plain_runs(coarse, unknowns));
  for (const LocalId n : others) add_entries(fine, n, coarse, unknowns, parts);
}

std::vector<LocalId> Transfer::find_runs(const LocalMesh& fine, const std::vector<NodeRun>& plain,
                                         const std::vector<NodeRun>& plain_coarse) {
  // runs address own coarse cells only: those of ghosts are numbered apart
  const RunsByRow coarse(plain_coarse);
  std::vector<NodeRun> found;
  for (const NodeRun& run : plain) {
    // a fine cell at column i has its parents at i/2, rounded down and up
    for (const NodeRun& below : coarse.in(run.at.j / 2)) {
      for (const NodeRun& above : coarse.in((run.at.j + 1) / 2)) {
        const int first = std::max({run.at.i, 2 * below.at.i, 2 * above.at.i});
        const int last = std::min(
            {run.end_column() - 1, 2 * (below.end_column() - 1), 2 * (above.end_column() - 1)});
        if (first > last) continue;
        const LocalId n = run.first + (first - run.at.i), count = last - first + 1;
        found.push_back({n, count, {first, run.at.j}});
        runs_.push_back({n, count, first % 2 == 1, below.first + (first / 2 - below.at.i),
                         above.first + (first / 2 - above.at.i)});
      }
    }
  }
  return nodes_between(found, fine.owned_nodes());
}

void Transfer::add_entries(const Scale& fine, LocalId node, const LocalMesh& coarse,
                           const CellUnknowns& unknowns, const CoarseParts& parts) {
  const GridIndex at = fine.mesh.node(node);
  const auto elements = fine.mesh.grid().elements_round(at);
  const SpecialCell* cell = fine.unknowns.special(node);
  const int pieces = cell ? cell->pieces->count : 1;
  int next = 0;  // pieces are numbered as they are met here
  for (std::size_t slot = 0; slot < 4 && next < pieces; ++slot) {
    const GridIndex e = elements[slot];
    if (!fine.mesh.grid().has_element(e)) continue;
    const int parts_here = cell ? int(cell->pieces->piece[slot].size()) : 1;
    for (int part = 0; part < parts_here; ++part) {
      const int piece = cell ? cell->pieces->piece[slot][std::size_t(part)] : 0;
      if (piece < next) continue;
      next = piece + 1;
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

void Transfer::few_to_coarse(const FewValues& fine, const Halo& halo,
                             std::span<double> coarse) const {
  const auto add = [&](LocalId coarse_unknown, LocalId component, double value) {
    coarse[std::size_t(coarse_unknown + component)] += value;
  };
  auto run = runs_.begin();
  for (const auto& [u, value] : fine) {
    while (run != runs_.end() && u >= 2 * (run->fine + run->count)) ++run;
    if (run == runs_.end()) break;
    if (u < 2 * run->fine) continue;
    const LocalId component = u % 2;
    const LocalId ahead = u / 2 - run->fine + LocalId(run->odd);  // in fine columns
    const double share = (run->above != run->below ? 0.5 : 1.0) * (ahead % 2 == 1 ? 0.5 : 1.0);
    for (const LocalId row : {run->below, run->above}) {
      add(2 * (row + ahead / 2), component, share * value);
      if (ahead % 2 == 1) add(2 * (row + ahead / 2 + 1), component, share * value);
      if (run->above == run->below) break;
    }
  }
  for (const Entry& e : entries_) {
    auto at = std::lower_bound(fine.begin(), fine.end(), e.fine,
                               [](const auto& few, LocalId u) { return few.first < u; });
    for (; at != fine.end() && at->first <= e.fine + 1; ++at)
      add(e.coarse, at->first - e.fine, e.weight * at->second);
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
