// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/plain_cells.hpp"

#include "core/base/marked.hpp"

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
                       const std::vector<GlobalId>& near_cracks)
    : cells_(&cells),
      inverse_(cells.regular().diagonal().inverse()),
      step_(std::size_t(cells.owned()), 0.0) {
  find_damping(whole_elements);
  lay_regular(cells.regular(), cells.owned());
  find_irregular(mesh, near_cracks);
  lay_halo(mesh, unknowns);
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

void PlainCells::lay_regular(const RegularRuns& regular, LocalId owned) {
  std::vector<RegularRun> inner, beside;
  LocalId end = 0;
  const auto close_gap = [&](LocalId next) {
    if (next > end) gaps_.push_back({end, next - end});
  };
  std::vector<char> near(std::size_t(owned / 2), 0);
  for (const RegularRun& run : regular.runs()) {
    LocalId done = 0;
    const auto add_beside = [&](LocalId next) {
      if (next == done) return;
      beside.push_back({run.node + done, next - done, run.below + done, run.above + done});
      const RegularRun& added = beside.back();
      for (const LocalId first : {added.below, added.node, added.above})
        std::fill_n(near.begin() + first - 1, added.count + 2, char(1));
    };
    for (const RegularRun& part : inner_parts(regular.runs(), run)) {
      inner.push_back(part);
      close_gap(2 * part.node);
      end = 2 * (part.node + part.count);
      add_beside(part.node - run.node);
      done = part.node + part.count - run.node;
    }
    add_beside(run.count);
  }
  close_gap(owned);
  for (const RegularRun& run : regular.runs()) {
    for (const LocalId k : marked({near.data() + run.node, std::size_t(run.count)})) {
      const LocalId u = 2 * (run.node + k);
      if (near_.empty() || near_.back().first + near_.back().count < u) near_.push_back({u, 0});
      near_.back().count += 2;
    }
  }
  RegularRuns::Stencil both = regular.stencil();
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      Eigen::Matrix2d block;
      for (Eigen::Index c = 0; c < 2; ++c)
        for (Eigen::Index d = 0; d < 2; ++d)
          block(c, d) = both[row][std::size_t(c)][2 * column + std::size_t(d)];
      block = second_ * inverse_ * block * inverse_;
      if (row == 1 && column == 1) block += first_ * inverse_;
      for (Eigen::Index c = 0; c < 2; ++c)
        for (Eigen::Index d = 0; d < 2; ++d)
          both[row][std::size_t(c)][2 * column + std::size_t(d)] = block(c, d);
    }
  }
  inner_ = RegularRuns(std::move(inner), both);
  beside_ = RegularRuns(std::move(beside), regular.stencil());
}

void PlainCells::find_irregular(const LocalMesh& mesh, const std::vector<GlobalId>& near_cracks) {
  // rows of plain unknowns come first, two and two
  auto near = near_cracks.begin();
  auto held = cells_->held().begin();
  const auto is_held = [&](LocalId u) {
    while (held != cells_->held().end() && *held < u) ++held;
    return held != cells_->held().end() && *held == u;
  };
  const StiffnessRows& rows = cells_->rows();
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
    irregular_.push_back({u, row, inverse_of_free(own, x, y)});
  }
}

void PlainCells::lay_halo(const LocalMesh& mesh, const CellUnknowns& unknowns) {
  const auto& with_rows = cells_->rows().unknown;
  first_ghost_row_ = std::size_t(
      std::lower_bound(with_rows.begin(), with_rows.end(), unknowns.owned()) - with_rows.begin());
  const LocalId ghosts = LocalId(2 * irregular_.size());
  const LocalId elsewhere = ghosts + (unknowns.count() - unknowns.owned());
  reached_.assign(std::size_t(elsewhere) + 1, 0.0);

  std::vector<SharedUnknowns> shared = unknowns.shared(mesh);
  for (SharedUnknowns& s : shared) {
    for (LocalId& u : s.owned) {
      const auto cell =
          std::lower_bound(irregular_.begin(), irregular_.end(), u - u % 2,
                           [](const Cell& c, LocalId unknown) { return c.unknown < unknown; });
      const bool counts = cell != irregular_.end() && cell->unknown == u - u % 2;
      u = counts ? 2 * LocalId(cell - irregular_.begin()) + u % 2 : elsewhere;
    }
    for (LocalId& u : s.ghosts) u += ghosts - unknowns.owned();
  }
  halo_ = Halo(cells_->communicator(), std::move(shared));
}

void PlainCells::take_first_step(std::span<const double> forces) const {
  const auto step = [&](std::size_t u, const Eigen::Matrix2d& inverse) {
    const Vec2 move = inverse * Vec2(forces[u], forces[u + 1]);
    step_[u] = move.x();
    step_[u + 1] = move.y();
  };
  for (const Range& range : near_)
    for (LocalId k = 0; k < range.count; k += 2) step(std::size_t(range.first + k), inverse_);
  for (const Cell& cell : irregular_) step(std::size_t(cell.unknown), cell.inverse);
}

void PlainCells::find_reached() const {
  const StiffnessRows& rows = cells_->rows();
  const LocalId owned = cells_->owned();
  for (std::size_t k = 0; k < irregular_.size(); ++k) {
    reached_[2 * k] = rows.times(irregular_[k].row, step_, owned);
    reached_[2 * k + 1] = rows.times(irregular_[k].row + 1, step_, owned);
  }
  const std::size_t ghosts = 2 * irregular_.size();
  std::fill(reached_.begin() + std::ptrdiff_t(ghosts), reached_.end(), 0.0);
  for (std::size_t row = first_ghost_row_; row < rows.unknown.size(); ++row)
    reached_[ghosts + std::size_t(rows.unknown[row] - owned)] = rows.times(row, step_, owned);
  halo_.add_forces(reached_);
}

void PlainCells::move_others(std::span<const double> forces, std::span<double> moves) const {
  take_first_step(forces);
  const auto add = [&](std::size_t u, const Eigen::Matrix2d& inverse, const Vec2& reached) {
    const Vec2 move = inverse * (first_ * Vec2(forces[u], forces[u + 1]) + second_ * reached);
    moves[u] += move.x();
    moves[u + 1] += move.y();
  };
  beside_.for_each_force(step_.data(), [&](std::ptrdiff_t u, const Eigen::Array2d& reached) {
    add(std::size_t(u), inverse_, reached.matrix());
  });
  find_reached();
  for (std::size_t k = 0; k < irregular_.size(); ++k)
    add(std::size_t(irregular_[k].unknown), irregular_[k].inverse,
        Vec2(reached_[2 * k], reached_[2 * k + 1]));
}

void PlainCells::move(std::span<const double> forces, std::span<double> moves) const {
  inner_.add(forces, moves);
  move_others(forces, moves);
}

void PlainCells::start(std::span<const double> forces, std::span<double> moves) const {
  inner_.apply(forces, moves);
  for (const Range& gap : gaps_) std::fill_n(moves.begin() + gap.first, gap.count, 0.0);
  move_others(forces, moves);
}

}  // namespace cdca
