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

PlainCells::PlainCells(const LocalMesh& mesh, const CellUnknowns& unknowns,
                       const CellStiffness& cells, const PlainStiffness& plain,
                       const std::vector<GlobalId>& near_cracks)
    : omega_(jacobi_damping(plain)) {
  inverse_ = omega_ * cells.regular().diagonal().inverse();
  std::vector<char> done(std::size_t(mesh.owned_nodes()), 0);
  for (const GlobalId id : near_cracks) {
    const LocalId n = mesh.find_node(mesh.grid().node_index(id));
    if (n >= 0 && mesh.owns(n)) done[std::size_t(n)] = 1;
  }
  LocalId end = 0;
  const auto close_gap = [&](LocalId next) {
    if (next > end) gaps_.push_back({end, next - end});
  };
  for (const RegularRun& run : cells.regular().runs()) {
    runs_.push_back({2 * run.node, 2 * run.count});
    close_gap(2 * run.node);
    end = 2 * (run.node + run.count);
    std::fill_n(done.begin() + run.node, run.count, char(1));
  }
  close_gap(cells.owned());
  std::vector<char> held(std::size_t(unknowns.count()), 0);
  for (const LocalId u : cells.held()) held[std::size_t(u)] = 1;
  const StiffnessRows& rows = cells.rows();
  for (LocalId n = 0; n < mesh.owned_nodes(); ++n) {
    if (done[std::size_t(n)]) continue;
    const LocalId u = unknowns.of_piece(n, 0);
    Eigen::Matrix2d own = Eigen::Matrix2d::Zero();
    for (LocalId c = 0; c < 2; ++c) {
      const auto row = std::size_t(rows.find(u + c));
      for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k) {
        const LocalId other = rows.column[k] - u;
        if (other == 0 || other == 1) own(c, other) = rows.value[k];
      }
    }
    const bool x = held[std::size_t(u)], y = held[std::size_t(u) + 1];
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
