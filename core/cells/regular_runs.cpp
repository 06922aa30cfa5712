// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/regular_runs.hpp"

#include "core/base/errors.hpp"

#include <Eigen/LU>

namespace cdca {

RegularRuns::RegularRuns(const LocalMesh& mesh, const std::vector<NodeRun>& regular,
                         const Eigen::Matrix<double, 8, 8>& k) {
  for (const NodeRun& run : regular) {
    runs_.push_back({run.first, run.count, mesh.find_node({run.at.i, run.at.j - 1}),
                     mesh.find_node({run.at.i, run.at.j + 1})});
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
  find_mirrored();
}

RegularRuns::RegularRuns(std::vector<RegularRun> runs, const Stencil& stencil)
    : runs_(std::move(runs)), stencil_(stencil) {
  inverse_ = diagonal().inverse();
  find_mirrored();
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

void RegularRuns::find_mirrored() {
  const auto at = [this](std::size_t row, std::size_t column) {
    return Pair(stencil_[row][0][2 * column], stencil_[row][1][2 * column + 1]);
  };
  mirrored_ = {at(1, 1), at(1, 2), at(2, 1), at(2, 2), stencil_[2][0][5]};
  // what the short form says of every neighbour must be what the long one says
  const double tolerance = 1e-10 * mirrored_.centre.maxCoeff();
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      const Pair expected = row == 1 ? (column == 1 ? mirrored_.centre : mirrored_.beside)
                                     : (column == 1 ? mirrored_.upright : mirrored_.corner);
      const double sign = (double(row) - 1) * (double(column) - 1);
      const Pair cross(stencil_[row][0][2 * column + 1], stencil_[row][1][2 * column]);
      if (((at(row, column) - expected).abs() > tolerance).any() ||
          ((cross - sign * mirrored_.cross).abs() > tolerance).any()) {
        throw SolveError("the stiffness of an element is not symmetric about its axes");
      }
    }
  }
}

void RegularRuns::apply(std::span<const double> x, std::span<double> forces) const {
  double* out = forces.data();
  for_each_force(x.data(),
                 [out](std::ptrdiff_t k, const Pair& force) { Eigen::Map<Pair>(out + k) = force; });
}

void RegularRuns::add(std::span<const double> x, std::span<double> forces) const {
  double* out = forces.data();
  for_each_force(
      x.data(), [out](std::ptrdiff_t k, const Pair& force) { Eigen::Map<Pair>(out + k) += force; });
}

void RegularRuns::set_residual(std::span<const double> forces, std::span<const double> x,
                               std::span<double> residual) const {
  const double* in = forces.data();
  double* out = residual.data();
  for_each_force(x.data(), [in, out](std::ptrdiff_t k, const Pair& force) {
    Eigen::Map<Pair>(out + k) = Eigen::Map<const Pair>(in + k) - force;
  });
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
