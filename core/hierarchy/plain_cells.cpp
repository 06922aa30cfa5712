// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/plain_cells.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>

namespace cdca {

double jacobi_damping(const PlainStiffness& element) {
  PlainStiffness blocks = PlainStiffness::Zero();
  for (int a = 0; a < 8; a += 2) blocks.block<2, 2>(a, a) = element.block<2, 2>(a, a);
  const Eigen::GeneralizedSelfAdjointEigenSolver<PlainStiffness> pairs(element, blocks,
                                                                       Eigen::EigenvaluesOnly);
  return 4.0 / (3.0 * pairs.eigenvalues()[7]);
}

PlainCells::PlainCells(const LocalMesh& mesh, const CellStiffness& cells,
                       const PlainStiffness& plain, const std::vector<GlobalId>& near_cracks)
    : omega_(jacobi_damping(plain)) {
  inverse_ = omega_ * cells.regular().diagonal().inverse();
  LocalId end = 0;
  const auto close_gap = [&](LocalId next) {
    if (next > end) gaps_.push_back({end, next - end});
  };
  for (const RegularRun& run : cells.regular().runs()) {
    runs_.push_back({2 * run.node, 2 * run.count});
    close_gap(2 * run.node);
    end = 2 * (run.node + run.count);
  }
  close_gap(cells.owned());
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
    Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();
    if (!x && !y) inverse = own.inverse();
    if (x && !y) inverse(1, 1) = 1 / own(1, 1);
    if (!x && y) inverse(0, 0) = 1 / own(0, 0);
    if (!x || !y) cells_.push_back({u, omega_ * 0.5 * (inverse + inverse.transpose())});
  }
}

template <class Store>
void PlainCells::for_each_regular(const double* forces, const Store& store) const {
  using Pair = Eigen::Array2d;
  const Pair own(inverse_(0, 0), inverse_(1, 1));
  const double cross = inverse_(0, 1);
  for (const Run& run : runs_) {
    for (std::ptrdiff_t k = run.first; k < run.first + run.count; k += 2) {
      const Pair force = Eigen::Map<const Pair>(forces + k);
      store(k, Pair(own * force + cross * Pair(force.reverse())));
    }
  }
}

void PlainCells::move_others(std::span<const double> forces, std::span<double> moves) const {
  for (const Cell& cell : cells_) {
    const auto u = std::size_t(cell.unknown);
    const Vec2 move = cell.inverse * Vec2(forces[u], forces[u + 1]);
    moves[u] += move.x();
    moves[u + 1] += move.y();
  }
}

void PlainCells::move(std::span<const double> forces, std::span<double> moves) const {
  double* out = moves.data();
  for_each_regular(forces.data(), [out](std::ptrdiff_t k, const Eigen::Array2d& move) {
    Eigen::Map<Eigen::Array2d>(out + k) += move;
  });
  move_others(forces, moves);
}

void PlainCells::start(std::span<const double> forces, std::span<double> moves) const {
  double* out = moves.data();
  for_each_regular(forces.data(), [out](std::ptrdiff_t k, const Eigen::Array2d& move) {
    Eigen::Map<Eigen::Array2d>(out + k) = move;
  });
  for (const Run& gap : gaps_) std::fill_n(moves.begin() + gap.first, gap.count, 0.0);
  move_others(forces, moves);
}

}  // namespace cdca
