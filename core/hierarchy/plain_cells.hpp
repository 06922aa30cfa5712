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
  PlainCells(const LocalMesh& mesh, const CellUnknowns& unknowns, const CellStiffness& cells,
             const PlainStiffness& plain, const std::vector<GlobalId>& near_cracks);

  void move(std::span<const double> forces, std::span<double> moves) const;
  double damping() const { return omega_; }

 private:
  struct Cell {
    LocalId unknown;          ///< x; y follows
    Eigen::Matrix2d inverse;  ///< times omega; rows of held unknowns are 0
  };
  struct Run {
    LocalId node;
    LocalId count;
  };
  std::vector<Run> runs_;
  std::vector<Cell> cells_;
  Eigen::Matrix2d inverse_ = Eigen::Matrix2d::Zero();  ///< of regular cells, times omega
  double omega_ = 1.0;
};

/// Four thirds over the largest eigenvalue of D^-1 K of one element, D the blocks of its corners:
/// no assembly of such elements has a larger one.
double jacobi_damping(const PlainStiffness& element);

}  // namespace cdca
