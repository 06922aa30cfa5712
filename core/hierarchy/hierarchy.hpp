// SPDX-License-Identifier: BSD-3-Clause
/// Cellular automata on coarser and coarser scales, split by the cracks on every one.
#pragma once

#include "core/hierarchy/coarse_parts.hpp"
#include "core/hierarchy/coarsest_solve.hpp"
#include "core/hierarchy/plain_cells.hpp"
#include "core/hierarchy/transfer.hpp"
#include "core/hierarchy/windows.hpp"
#include "core/solver/scales.hpp"

#include <memory>
#include <vector>

namespace cdca {

struct HierarchyShape {
  WindowShape windows;
  /// A scale with no more nodes than this is the coarsest.
  GlobalId coarsest_nodes = 0;
};

/// What is needed of the finest scale; borrowed, and to live as long as the hierarchy built on it.
struct FinestScale {
  const BasisContext& basis;
  const ElasticMatrix& elastic;
  const std::vector<char>& held;       ///< of every unknown
  const std::vector<double>& springs;  ///< of every unknown, relative; may be empty
  const FaceSprings* faces;            ///< between touching faces; null for none
  /// What has stayed since build() was called last; null for nothing.
  const CarriedCells* carried = nullptr;
};

/// All scales of a body.
class Hierarchy final : public Scales {
 public:
  explicit Hierarchy(const HierarchyShape& shape) : shape_(shape) {}

  /// Lays out the windows of the finest scale. Returns the cells that need rows of their own.
  std::vector<GlobalId> plan(const BasisContext& basis);
  /// Everything else, on the finest scale's cells. Kept from call to call are meshes of coarse
  /// scales, factors of windows whose stiffness is the same, and the order of elimination on the
  /// coarsest scale; with `carried` also coarse elements, rows and windows that growth has left as
  /// they were. Collective.
  void build(const FinestScale& finest, const CellStiffness& cells);

  /// The springs of the cells have turned. Only where one factor moves all cells; the next solve
  /// makes it anew.
  void turn_springs();
  /// As of CoarsestSolve, and only where turn_springs() is. Collective.
  Eigen::MatrixXd compliance(std::size_t measures, const std::vector<Effect>& effects) const;

  std::size_t count() const override { return levels_.size(); }
  const Scale& scale(std::size_t index) const override;
  const WindowFactors& factors() const { return factors_; }

 private:
  class Level;
  struct LevelDeleter {
    void operator()(Level* level) const;
  };
  void lay_meshes(const LocalMesh& finest);
  bool is_coarsest(const StructuredGrid& grid) const {
    return grid.node_count() <= shape_.coarsest_nodes || std::min(grid.nx(), grid.ny()) <= 2;
  }

  HierarchyShape shape_;
  WindowPlans finest_plans_;
  std::vector<LocalMesh> meshes_;  ///< of the coarse scales
  std::unique_ptr<ScaleParts> finest_parts_;
  std::vector<std::unique_ptr<Level, LevelDeleter>> levels_;
  WindowFactors factors_;
  CoarsestFactor coarsest_factor_;
};

}  // namespace cdca
