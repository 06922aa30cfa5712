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
  for (const RegularRun& run : cells.regular().runs()) {
    runs_.push_back({run.node, run.count});
    std::fill_n(done.begin() + run.node, run.count, char(1));
  }
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

void PlainCells::move(std::span<const double> forces, std::span<double> moves) const {
  const double xx = inverse_(0, 0), xy = inverse_(0, 1), yy = inverse_(1, 1);
  for (const Run& run : runs_) {
    const double* f = &forces[2 * std::size_t(run.node)];
    double* u = &moves[2 * std::size_t(run.node)];
    for (std::ptrdiff_t k = 0; k < 2 * std::ptrdiff_t(run.count); k += 2) {
      u[k] += xx * f[k] + xy * f[k + 1];
      u[k + 1] += xy * f[k] + yy * f[k + 1];
    }
  }
  for (const Cell& cell : cells_) {
    const auto u = std::size_t(cell.unknown);
    const Vec2 move = cell.inverse * Vec2(forces[u], forces[u + 1]);
    moves[u] += move.x();
    moves[u + 1] += move.y();
  }
}

}  // namespace cdca
