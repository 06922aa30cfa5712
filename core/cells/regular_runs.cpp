// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/regular_runs.hpp"

#include <Eigen/LU>

namespace cdca {

RegularRuns::RegularRuns(const LocalMesh& mesh, const std::vector<char>& regular,
                         const Eigen::Matrix<double, 8, 8>& k) {
  for (LocalId n = 0; n < mesh.owned_nodes(); ++n) {
    if (!regular[std::size_t(n)]) continue;
    const GridIndex at = mesh.node(n);
    if (!runs_.empty()) {
      RegularRun& last = runs_.back();
      const GridIndex before = mesh.node(last.node + last.count - 1);
      if (last.node + last.count == n && before.j == at.j) {
        ++last.count;
        continue;
      }
    }
    runs_.push_back({n, 1, mesh.find_node({at.i, at.j - 1}), mesh.find_node({at.i, at.j + 1})});
  }
  // the node is corner (slot + 2) % 4 of the element in each slot round it
  constexpr std::array<std::array<int, 2>, 4> corner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t slot = 0; slot < 4; ++slot) {
    const std::size_t own = (slot + 2) % 4;
    for (std::size_t b = 0; b < 4; ++b) {
      const auto column = std::size_t(1 + corner[b][0] - corner[own][0]);
      const auto row = std::size_t(1 + corner[b][1] - corner[own][1]);
      for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t d = 0; d < 2; ++d) {
          stencil_[row][c][2 * column + d] += k(Eigen::Index(2 * own + c), Eigen::Index(2 * b + d));
        }
      }
    }
  }
  inverse_ = diagonal().inverse();
}

Eigen::Matrix2d RegularRuns::diagonal() const {
  Eigen::Matrix2d centre;
  centre << stencil_[1][0][2], stencil_[1][0][3], stencil_[1][1][2], stencil_[1][1][3];
  return centre;
}

std::int64_t RegularRuns::cells() const {
  std::int64_t sum = 0;
  for (const RegularRun& run : runs_) sum += run.count;
  return sum;
}

void RegularRuns::apply(std::span<const double> x, std::span<double> forces) const {
  for (const RegularRun& run : runs_) {
    const double* rows[3] = {&x[2 * std::size_t(run.below) - 2], &x[2 * std::size_t(run.node) - 2],
                             &x[2 * std::size_t(run.above) - 2]};
    double* f = &forces[2 * std::size_t(run.node)];
    const auto values = 2 * std::ptrdiff_t(run.count);
    for (std::ptrdiff_t n = 0; n < values; n += 2) {
      double fx = 0.0, fy = 0.0;
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t m = 0; m < 6; ++m) {
          const double v = rows[r][n + std::ptrdiff_t(m)];
          fx += stencil_[r][0][m] * v;
          fy += stencil_[r][1][m] * v;
        }
      }
      f[n] = fx;
      f[n + 1] = fy;
    }
  }
}

void RegularRuns::sweep(const RegularRun& run, bool forward, double omega, std::span<double> forces,
                        std::span<double> displacements) const {
  double* rows[3] = {&forces[2 * std::size_t(run.below) - 2],
                     &forces[2 * std::size_t(run.node) - 2],
                     &forces[2 * std::size_t(run.above) - 2]};
  double* u = &displacements[2 * std::size_t(run.node)];
  for (LocalId k = 0; k < run.count; ++k) {
    const std::ptrdiff_t n = 2 * std::ptrdiff_t(forward ? k : run.count - 1 - k);
    const double fx = omega * rows[1][n + 2], fy = omega * rows[1][n + 3];
    const double dx = inverse_(0, 0) * fx + inverse_(0, 1) * fy;
    const double dy = inverse_(1, 0) * fx + inverse_(1, 1) * fy;
    u[n] += dx;
    u[n + 1] += dy;
    // K_ki = K_ik^T: the cell's own row, transposed, is what it does to its neighbours
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t m = 0; m < 6; ++m) {
        rows[r][n + std::ptrdiff_t(m)] -= stencil_[r][0][m] * dx + stencil_[r][1][m] * dy;
      }
    }
  }
}

}  // namespace cdca
