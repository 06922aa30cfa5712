// SPDX-License-Identifier: BSD-3-Clause
/// What holds the cells of coarser and coarser scales.
#pragma once

#include "core/cells/cell_stiffness.hpp"
#include "core/hierarchy/transfer.hpp"

#include <functional>
#include <vector>

namespace cdca {

/// Supports and weak springs of a scale, made from those of the scale below.
///
/// A coarse unknown is held when any of its children is: coarse moves vanish at supports, and no
/// coarse element needs to know of them. A support that stands alone, at a point, is different:
/// seen from afar it yields, since displacements round a point force grow with the logarithm of
/// the distance. From each scale to the next it is a spring in series with the material between,
/// 1/s' = 1/s + softening. Held hard instead it would cost steps of CG on every scale.
class CoarseSupports {
 public:
  /// Moves or forces of a scale, on all cells of the next one.
  using ToCoarse = std::function<std::vector<double>(const FewValues&)>;

  /// Of the finest scale. held, springs: as for CellStiffness.
  CoarseSupports(const std::vector<char>& held, const std::vector<double>& springs,
                 double softening);
  /// Goes on to the next scale. cells: of the scale so far. Collective.
  void coarsen(const CellStiffness& cells, const ToCoarse& to_coarse);

  /// Of every unknown; ghosts never.
  const std::vector<char>& held() const { return held_; }
  /// Of every unknown, relative to its own stiffness; empty for none.
  std::vector<double> springs() const;
  /// Plain own cells with a spring for a point, which need rows of their own.
  std::vector<GlobalId> cells_at_points(const LocalMesh& mesh) const;

 private:
  std::vector<char> held_;
  FewValues weak_;    ///< springs of bodies that nothing holds
  FewValues points_;  ///< springs for supports at points
  double softening_;
};

/// What a support at a point gains in compliance from one scale to the next, times the stiffness
/// of a cell: K_ii (ln 2 / 4 pi) (1 / mu + 1 / (lambda + 2 mu)), from Kelvin's solution in the
/// plane. It is the same at sides and corners, where both factors change alike.
double point_softening(const PlainStiffness& element, const ElasticMatrix& elastic);

}  // namespace cdca
