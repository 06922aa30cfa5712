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
  /// Row r (below, same, above), component of the force, then x and y of the three cells there.
  using Stencil = std::array<std::array<std::array<double, 6>, 2>, 3>;

  RegularRuns() = default;
  /// All nine cells of a regular cell's stencil are own and plain.
  RegularRuns(const LocalMesh& mesh, const std::vector<NodeRun>& regular,
              const Eigen::Matrix<double, 8, 8>& element_stiffness);
  /// Of a stencil that is the same mirrored in x and y.
  RegularRuns(std::vector<RegularRun> runs, const Stencil& stencil);

  const std::vector<RegularRun>& runs() const { return runs_; }
  std::int64_t cells() const;
  const Stencil& stencil() const { return stencil_; }
  /// K_i of a regular cell.
  Eigen::Matrix2d diagonal() const;
  /// forces = K x for the cells of all runs.
  void apply(std::span<const double> x, std::span<double> forces) const;
  /// forces += K x for the cells of all runs.
  void add(std::span<const double> x, std::span<double> forces) const;
  /// residual = forces - K x for the cells of all runs.
  void set_residual(std::span<const double> forces, std::span<const double> x,
                    std::span<double> residual) const;
  /// The rule for one run, in the direction of growing node numbers or against it.
  void sweep(const RegularRun& run, bool forward, double omega, std::span<double> forces,
             std::span<double> displacements) const;

 private:
  using Pair = Eigen::Array2d;  ///< x and y of one cell
  /// The same stencil, mirrored in x and y onto itself: x acts on x, and y on y, alike from both
  /// sides; x on y, and y on x, from the corners only, with changing signs.
  struct Mirrored {
    Pair centre, beside, upright, corner;
    double cross = 0.0;  ///< of the upper right corner
  };

  void find_mirrored();
  template <class Store>
  void for_each_force(const double* x, const Store& store) const;

  std::vector<RegularRun> runs_;
  Stencil stencil_{};
  Mirrored mirrored_;
  Eigen::Matrix2d inverse_ = Eigen::Matrix2d::Zero();
};

}  // namespace cdca
