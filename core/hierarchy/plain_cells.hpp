// SPDX-License-Identifier: BSD-3-Clause
/// The rule for all cells away from cracks at once.
#pragma once

#include "core/cells/cell_stiffness.hpp"

#include <span>
#include <vector>

namespace cdca {

/// Damped block Jacobi: moves += omega K_i^-1 f_i for every cell that no window must move.
class PlainCells {
 public:
  PlainCells() = default;
  /// near_cracks: own nodes left out, ascending global ids.
  PlainCells(const LocalMesh& mesh, const CellStiffness& cells, const PlainStiffness& plain,
             const std::vector<GlobalId>& near_cracks);

  void move(std::span<const double> forces, std::span<double> moves) const;
  /// As move(), with all own moves 0 before.
  void start(std::span<const double> forces, std::span<double> moves) const;
  double damping() const { return omega_; }

 private:
  struct Cell {
    LocalId unknown;          ///< x; y follows
    Eigen::Matrix2d inverse;  ///< times omega; rows of held unknowns are 0
  };
  /// Consecutive own unknowns.
  struct Run {
    LocalId first;
    LocalId count;
  };
  /// Calls store(place, move) for every cell of the runs.
  template <class Store>
  void for_each_regular(const double* forces, const Store& store) const;
  void move_others(std::span<const double> forces, std::span<double> moves) const;

  std::vector<Run> runs_;
  std::vector<Run> gaps_;  ///< between the runs
  std::vector<Cell> cells_;
  Eigen::Matrix2d inverse_ = Eigen::Matrix2d::Zero();  ///< of regular cells, times omega
  double omega_ = 1.0;
};

/// Four thirds over the largest eigenvalue of D^-1 K of one element, D the blocks of its corners:
/// no assembly of such elements has a larger one.
double jacobi_damping(const PlainStiffness& element);

}  // namespace cdca
