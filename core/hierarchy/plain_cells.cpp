// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/plain_cells.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>

namespace cdca {

namespace {

struct Interval {
  LocalId first, end;
};

/// The cells from `first` to `end` that have both neighbours in their own run.
std::vector<Interval> amid_runs(const std::vector<RegularRun>& runs, LocalId first, LocalId end) {
  std::vector<Interval> found;
  auto run = std::upper_bound(runs.begin(), runs.end(), first,
                              [](LocalId n, const RegularRun& r) { return n < r.node; });
  if (run != runs.begin()) --run;
  for (; run != runs.end() && run->node < end; ++run) {
    const Interval part{std::max(first, run->node + 1), std::min(end, run->node + run->count - 1)};
    if (part.first < part.end) found.push_back(part);
  }
  return found;
}

/// The parts of a run whose cells have all eight neighbours in runs.
std::vector<RegularRun> inner_parts(const std::vector<RegularRun>& runs, const RegularRun& run) {
  std::vector<RegularRun> parts;
  if (run.count < 3) return parts;
  const auto below = amid_runs(runs, run.below + 1, run.below + run.count - 1);
  const auto above = amid_runs(runs, run.above + 1, run.above + run.count - 1);
  for (const Interval& b : below) {
    for (const Interval& a : above) {
      const LocalId first = std::max(b.first - run.below, a.first - run.above),
                    end = std::min(b.end - run.below, a.end - run.above);
      if (first < end)
        parts.push_back({run.node + first, end - first, run.below + first, run.above + first});
    }
  }
  return parts;
}

/// The inverse of an own block, 0 in rows of held unknowns.
Eigen::Matrix2d inverse_of_free(const Eigen::Matrix2d& own, bool x_held, bool y_held) {
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();
  if (!x_held && !y_held) inverse = own.inverse();
  if (x_held && !y_held) inverse(1, 1) = 1 / own(1, 1);
  if (!x_held && y_held) inverse(0, 0) = 1 / own(0, 0);
  return 0.5 * (inverse + inverse.transpose());
}

}  // namespace

double largest_rate(const PlainStiffness& element) {
  PlainStiffness blocks = PlainStiffness::Zero();
  for (int a = 0; a < 8; a += 2) blocks.block<2, 2>(a, a) = element.block<2, 2>(a, a);
  const Eigen::GeneralizedSelfAdjointEigenSolver<PlainStiffness> pairs(element, blocks,
                                                                       Eigen::EigenvaluesOnly);
  return pairs.eigenvalues()[7];
}

PlainCells::PlainCells(const LocalMesh& mesh, const CellUnknowns& unknowns,
                       const CellStiffness& cells,
                       const std::vector<PlainStiffness>& whole_elements,
                       const std::vector<GlobalId>& near_cracks) {
  find_damping(whole_elements);
  find_outer(mesh, cells, near_cracks);
  lay_inner(cells.regular(), cells.owned());
  lay_outer(mesh, unknowns, cells);
}

void PlainCells::find_damping(const std::vector<PlainStiffness>& whole_elements) {
  double largest = 0.0;
  for (const PlainStiffness& k : whole_elements) largest = std::max(largest, largest_rate(k));
  // what two steps leave of a rate x is T_2((m - x) / r) / T_2(m / r), T_2(t) = 2 t^2 - 1
  const double m = 0.5 * (1.0 + least_rough) * largest, r = 0.5 * (1.0 - least_rough) * largest;
  const double at_zero = 2.0 * (m / r) * (m / r) - 1.0;
  first_ = 4.0 * m / (r * r) / at_zero;
  second_ = -2.0 / (r * r) / at_zero;
}

void PlainCells::lay_inner(const RegularRuns& regular, LocalId owned) {
  const Eigen::Matrix2d inverse = regular.diagonal().inverse();
  std::vector<RegularRun> inner;
  LocalId end = 0;
  const auto close_gap = [&](LocalId next) {
    if (next > end) gaps_.push_back({end, next - end});
  };
  for (const RegularRun& run : regular.runs()) {
    LocalId outer = run.node;
    const auto add_outer = [&](LocalId next) {
      for (; outer < next; ++outer) outer_.push_back({2 * outer, of_run, inverse});
    };
    for (const RegularRun& part : inner_parts(regular.runs(), run)) {
      inner.push_back(part);
      close_gap(2 * part.node);
      end = 2 * (part.node + part.count);
      add_outer(part.node);
      outer = part.node + part.count;
    }
    add_outer(run.node + run.count);
  }
  close_gap(owned);
  RegularRuns::Stencil both = regular.stencil();
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      Eigen::Matrix2d block;
      for (Eigen::Index c = 0; c < 2; ++c)
        for (Eigen::Index d = 0; d < 2; ++d)
          block(c, d) = both[row][std::size_t(c)][2 * column + std::size_t(d)];
      block = second_ * inverse * block * inverse;
      if (row == 1 && column == 1) block += first_ * inverse;
      for (Eigen::Index c = 0; c < 2; ++c)
        for (Eigen::Index d = 0; d < 2; ++d)
          both[row][std::size_t(c)][2 * column + std::size_t(d)] = block(c, d);
    }
  }
  inner_ = RegularRuns(std::move(inner), both);
}

void PlainCells::find_outer(const LocalMesh& mesh, const CellStiffness& cells,
                            const std::vector<GlobalId>& near_cracks) {
  // rows of plain unknowns come first, two and two
  auto near = near_cracks.begin();
  auto held = cells.held().begin();
  const auto is_held = [&](LocalId u) {
    while (held != cells.held().end() && *held < u) ++held;
    return held != cells.held().end() && *held == u;
  };
  const StiffnessRows& rows = cells.rows();
  for (std::size_t row = 0; row < rows.unknown.size(); row += 2) {
    const LocalId u = rows.unknown[row], n = u / 2;
    if (!mesh.owns(n)) break;
    const GlobalId id = mesh.node_id(n);
    while (near != near_cracks.end() && *near < id) ++near;
    if (near != near_cracks.end() && *near == id) continue;
    Eigen::Matrix2d own = Eigen::Matrix2d::Zero();
    for (LocalId c = 0; c < 2; ++c) {
      const std::size_t of_c = row + std::size_t(c);
      for (std::size_t k = rows.start[of_c]; k < rows.start[of_c + 1]; ++k) {
        const LocalId other = rows.column[k] - u;
        if (other == 0 || other == 1) own(c, other) = rows.value[k];
      }
    }
    const bool x = is_held(u), y = is_held(u + 1);
    outer_.push_back({u, row, inverse_of_free(own, x, y)});
  }
}

void PlainCells::lay_outer(const LocalMesh& mesh, const CellUnknowns& unknowns,
                           const CellStiffness& cells) {
  // where the inverse of a node's own block is
  constexpr int regular = -1, of_window = -2;
  std::vector<int> place(std::size_t(mesh.owned_nodes()), of_window);
  for (const RegularRun& run : cells.regular().runs())
    std::fill_n(place.begin() + run.node, run.count, regular);
  for (std::size_t k = 0; k < outer_.size(); ++k)
    place[std::size_t(outer_[k].unknown / 2)] = int(k);
  const Eigen::Matrix2d of_regular = cells.regular().diagonal().inverse();

  StiffnessRows& after = after_step_;
  // in order of columns: two of one node follow each other
  const auto add_entry = [&](LocalId column, double value) {
    const LocalId n = column / 2;
    if (n >= mesh.owned_nodes() || place[std::size_t(n)] == of_window) return;
    const int at = place[std::size_t(n)];
    const Eigen::Matrix2d& inverse = at == regular ? of_regular : outer_[std::size_t(at)].inverse;
    if (after.column.size() == after.start.back() || after.column.back() != 2 * n + 1) {
      after.column.insert(after.column.end(), {2 * n, 2 * n + 1});
      after.value.insert(after.value.end(), {0.0, 0.0});
    }
    for (Eigen::Index d = 0; d < 2; ++d)
      after.value[after.value.size() - 2 + std::size_t(d)] += value * inverse(column % 2, d);
  };
  constexpr std::size_t usual = 18;  // of a row, in nine cells
  after.start.reserve(2 * outer_.size());
  after.column.reserve(2 * usual * outer_.size());
  after.value.reserve(2 * usual * outer_.size());
  const auto end_row = [&] { after.start.push_back(after.column.size()); };
  const StiffnessRows& rows = cells.rows();
  const auto add_row = [&](std::size_t row) {
    for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
      add_entry(rows.column[k], rows.value[k]);
    end_row();
  };
  const auto& runs = cells.regular().runs();
  auto run = runs.begin();  // cells of runs come in order
  for (const Cell& cell : outer_) {
    const LocalId n = cell.unknown / 2;
    if (cell.row != of_run) {
      for (std::size_t c = 0; c < 2; ++c) add_row(cell.row + c);
      continue;
    }
    while (n >= run->node + run->count) ++run;
    const LocalId k = n - run->node;
    const std::array<LocalId, 3> middle{run->below + k, n, run->above + k};
    for (std::size_t c = 0; c < 2; ++c) {
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t m = 0; m < 6; ++m)
          add_entry(2 * (middle[r] - 1) + LocalId(m), cells.regular().stencil()[r][c][m]);
      }
      end_row();
    }
  }
  const LocalId ghosts = LocalId(2 * outer_.size());
  for (LocalId u = unknowns.owned(); u < unknowns.count(); ++u) {
    const std::ptrdiff_t row = rows.find(u);
    row < 0 ? end_row() : add_row(std::size_t(row));
  }
  const LocalId elsewhere = ghosts + (unknowns.count() - unknowns.owned());
  end_row();
  reached_.assign(std::size_t(elsewhere) + 1, 0.0);

  std::vector<SharedUnknowns> shared = unknowns.shared(mesh);
  for (SharedUnknowns& s : shared) {
    for (LocalId& u : s.owned) {
      const LocalId n = u / 2;
      const int at = n < mesh.owned_nodes() ? place[std::size_t(n)] : of_window;
      u = at < 0 ? elsewhere : 2 * LocalId(at) + u % 2;
    }
    for (LocalId& u : s.ghosts) u += ghosts - unknowns.owned();
  }
  halo_ = Halo(cells.communicator(), std::move(shared));
}

void PlainCells::move_outer(std::span<const double> forces, std::span<double> moves) const {
  for (std::size_t row = 0; row < reached_.size(); ++row)
    reached_[row] = after_step_.times(row, forces, LocalId(forces.size()));
  halo_.add_forces(reached_);
  for (std::size_t k = 0; k < outer_.size(); ++k) {
    const auto u = std::size_t(outer_[k].unknown);
    const Vec2 force(forces[u], forces[u + 1]), reached(reached_[2 * k], reached_[2 * k + 1]);
    const Vec2 move = outer_[k].inverse * (first_ * force + second_ * reached);
    moves[u] += move.x();
    moves[u + 1] += move.y();
  }
}

void PlainCells::move(std::span<const double> forces, std::span<double> moves) const {
  inner_.add(forces, moves);
  move_outer(forces, moves);
}

void PlainCells::start(std::span<const double> forces, std::span<double> moves) const {
  inner_.apply(forces, moves);
  for (const Range& gap : gaps_) std::fill_n(moves.begin() + gap.first, gap.count, 0.0);
  move_outer(forces, moves);
}

}  // namespace cdca
