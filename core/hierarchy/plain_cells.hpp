// SPDX-License-Identifier: BSD-3-Clause
/// The rule for all cells away from cracks at once.
#pragma once

#include "core/cells/cell_stiffness.hpp"

#include <span>
#include <vector>

namespace cdca {

/// Two steps of the rule for every cell that no window must move, all at once, damped in the manner
/// of Chebyshev: moves += (a + b D^-1 K) D^-1 forces, K between these cells alone and D their own
/// blocks of it. That takes out the rough part of the forces, whose rates D^-1 K lie between
/// `least_rough` of the largest rate and this one.
class PlainCells {
 public:
  PlainCells() = default;
  /// whole_elements: the stiffness of all kinds of elements without cracks. near_cracks: own nodes
  /// left out, ascending global ids. Collective.
  PlainCells(const LocalMesh& mesh, const CellUnknowns& unknowns, const CellStiffness& cells,
             const std::vector<PlainStiffness>& whole_elements,
             const std::vector<GlobalId>& near_cracks);

  /// Collective.
  void move(std::span<const double> forces, std::span<double> moves) const;
  /// As move(), with all own moves 0 before. Collective.
  void start(std::span<const double> forces, std::span<double> moves) const;

 private:
  static constexpr double least_rough = 0.15;

  struct Cell {
    LocalId unknown;          ///< x; y follows
    std::size_t row;          ///< of x among the rows of all cells, or of_run
    Eigen::Matrix2d inverse;  ///< D^-1; rows of held unknowns are 0
  };
  static constexpr auto of_run = std::size_t(-1);  ///< the common stencil
  /// Consecutive own unknowns.
  struct Range {
    LocalId first;
    LocalId count;
  };

  void find_damping(const std::vector<PlainStiffness>& whole_elements);
  /// Regular cells all of whose neighbours are regular: both steps are one stencil there.
  void lay_inner(const RegularRuns& regular, LocalId owned);
  void find_outer(const LocalMesh& mesh, const CellStiffness& cells,
                  const std::vector<GlobalId>& near_cracks);
  void lay_outer(const LocalMesh& mesh, const CellUnknowns& unknowns, const CellStiffness& cells);
  void move_outer(std::span<const double> forces, std::span<double> moves) const;

  double first_ = 0.0, second_ = 0.0;  ///< a and b
  RegularRuns inner_;
  std::vector<Range> gaps_;  ///< between the runs of inner cells
  std::vector<Cell> outer_;  ///< the others
  /// K D^-1: what the forces on own cells do, after one step, to outer cells (x and y of each) and
  /// to unknowns of ghosts. Rows without entries stand for what does not count.
  StiffnessRows after_step_;
  Halo halo_;                            ///< of the rows
  mutable std::vector<double> reached_;  ///< one value per row
};

/// The largest eigenvalue of D^-1 K of one element, D the blocks of its corners: no assembly of
/// such elements has a larger one.
double largest_rate(const PlainStiffness& element);

}  // namespace cdca
