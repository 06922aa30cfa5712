// SPDX-License-Identifier: BSD-3-Clause
/// Regular cells: those that share one stencil. They are kept as runs of neighbours in a grid row.
#pragma once

#include "core/cells/part_stiffness.hpp"
#include "core/mesh/local_mesh.hpp"

#include <array>
#include <span>
#include <vector>

namespace cdca {

/// Consecutive cells of one grid row; the rows below and above are consecutive as well.
struct RegularRun {
  LocalId node = 0;  ///< first cell
  LocalId count = 0;
  LocalId below = 0;  ///< node under the first cell
  LocalId above = 0;
};

class RegularRuns {
 public:
  RegularRuns() = default;
  /// regular: for every own node. All nine cells of a regular cell's stencil are own and plain.
  RegularRuns(const LocalMesh& mesh, const std::vector<char>& regular,
              const Eigen::Matrix<double, 8, 8>& element_stiffness);

  const std::vector<RegularRun>& runs() const { return runs_; }
  std::int64_t cells() const;
  /// K_i of a regular cell.
  Eigen::Matrix2d diagonal() const;
  /// forces = K x for the cells of all runs.
  void apply(std::span<const double> x, std::span<double> forces) const;
  /// The rule for one run, in the direction of growing node numbers or against it.
  void sweep(const RegularRun& run, bool forward, double omega, std::span<double> forces,
             std::span<double> displacements) const;

 private:
  /// Row r (below, same, above), component of the force, then x and y of the three cells there.
  using Stencil = std::array<std::array<std::array<double, 6>, 2>, 3>;

  std::vector<RegularRun> runs_;
  Stencil stencil_{};
  Eigen::Matrix2d inverse_ = Eigen::Matrix2d::Zero();
};

}  // namespace cdca
