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
  /// Calls store(k, force) with the place of every cell's x among the unknowns and its force K x,
  /// an array of two.
  template <class Store>
  void for_each_force(const double* x, const Store& store) const;
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

  std::vector<RegularRun> runs_;
  Stencil stencil_{};
  Mirrored mirrored_;
  Eigen::Matrix2d inverse_ = Eigen::Matrix2d::Zero();
};

template <class Store>
void RegularRuns::for_each_force(const double* x, const Store& store) const {
  using Place = Eigen::Map<const Pair>;
  const Mirrored m = mirrored_;
  for (const RegularRun& run : runs_) {
    const double *below = x + 2 * std::ptrdiff_t(run.below),
                 *same = x + 2 * std::ptrdiff_t(run.node),
                 *above = x + 2 * std::ptrdiff_t(run.above);
    const std::ptrdiff_t first = 2 * std::ptrdiff_t(run.node),
                         count = 2 * std::ptrdiff_t(run.count);
    // sums and differences of the rows above and below: left, here, right
    Pair sum_left = Place(above - 2) + Place(below - 2), sum = Place(above) + Place(below);
    Pair turn_left = Place(above - 2) - Place(below - 2), turn = Place(above) - Place(below);
    for (std::ptrdiff_t k = 0; k < count; k += 2) {
      const Pair sum_right = Place(above + k + 2) + Place(below + k + 2);
      const Pair turn_right = Place(above + k + 2) - Place(below + k + 2);
      const Pair across = turn_right - turn_left;
      store(first + k, m.centre * Place(same + k) +
                           m.beside * (Place(same + k - 2) + Place(same + k + 2)) +
                           m.upright * sum + m.corner * (sum_left + sum_right) +
                           m.cross * Pair(across.reverse()));
      sum_left = sum, sum = sum_right;
      turn_left = turn, turn = turn_right;
    }
  }
}

}  // namespace cdca
