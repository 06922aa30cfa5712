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
    std::size_t row;          ///< of x among the rows of all cells
    Eigen::Matrix2d inverse;  ///< D^-1; rows of held unknowns are 0
  };
  /// Consecutive own unknowns.
  struct Range {
    LocalId first;
    LocalId count;
  };

  void find_damping(const std::vector<PlainStiffness>& whole_elements);
  /// Tells regular cells all of whose neighbours are regular, where both steps are one stencil,
  /// from those beside others.
  void lay_regular(const RegularRuns& regular, LocalId owned);
  void find_irregular(const LocalMesh& mesh, const std::vector<GlobalId>& near_cracks);
  void lay_halo(const LocalMesh& mesh, const CellUnknowns& unknowns);
  /// Of all cells but the inner ones.
  void move_others(std::span<const double> forces, std::span<double> moves) const;
  void take_first_step(std::span<const double> forces) const;
  /// What this step has done to irregular cells.
  void find_reached() const;

  const CellStiffness* cells_ = nullptr;
  double first_ = 0.0, second_ = 0.0;  ///< a and b
  RegularRuns inner_;
  std::vector<Range> gaps_;  ///< between the runs of inner cells
  RegularRuns beside_;       ///< regular cells beside irregular ones
  std::vector<Range> near_;  ///< these, and the regular cells round them
  Eigen::Matrix2d inverse_;  ///< D^-1 of regular cells
  std::vector<Cell> irregular_;
  std::size_t first_ghost_row_ = 0;  ///< among the rows of all cells
  Halo halo_;                        ///< of reached_
  /// D^-1 forces of the cells that others need it of, 0 elsewhere; own unknowns.
  mutable std::vector<double> step_;
  /// K of step_: x and y of irregular cells, then ghosts, then a place for what does not count.
  mutable std::vector<double> reached_;
};

/// The largest eigenvalue of D^-1 K of one element, D the blocks of its corners: no assembly of
/// such elements has a larger one.
double largest_rate(const PlainStiffness& element);

}  // namespace cdca
