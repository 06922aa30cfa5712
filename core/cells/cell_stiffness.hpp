// SPDX-License-Identifier: BSD-3-Clause
/// The stiffness of cells: one stencil for all regular ones, own rows for the others. No global
/// matrix exists.
#pragma once

#include "core/base/cell_system.hpp"
#include "core/base/halo.hpp"
#include "core/cells/cell_group.hpp"
#include "core/cells/element_stiffness.hpp"
#include "core/cells/idle_functions.hpp"
#include "core/cells/regular_runs.hpp"
#include "core/cells/stiffness_rows.hpp"

#include <memory>
#include <vector>

namespace cdca {

class CarriedCells;

/// Which sweeps of the rule the cells must be ready for.
enum class Sweeps { none, one_after_the_other };

/// Implements the rule for the cells of this rank, on any scale. Columns are owned: forces that own
/// cells put on ghosts go to the ghosts' owners.
class CellStiffness final : public CellSystem {
 public:
  /// held: for every unknown, whether a support prescribes it; springs: of every unknown, a weak
  /// spring as a part of its own stiffness, where nothing else holds its body (may be empty).
  /// own_rows: nodes of cells that get rows even though they are regular. carried: what can be
  /// taken over from before the cracks grew; null for nothing.
  CellStiffness(const LocalMesh& mesh, const CellUnknowns& unknowns, ElementStiffness& elements,
                const std::vector<char>& held, const std::vector<double>& springs,
                const std::vector<GlobalId>& own_rows, Sweeps sweeps, Communicator& communicator,
                const CarriedCells* carried = nullptr);

  /// Springs of faces are what the elements say now, and weak springs these; all else stays. Not
  /// for cells that sweep. Collective where the constructor is.
  void turn_springs(const LocalMesh& mesh, ElementStiffness& elements,
                    const std::vector<double>& springs);

  LocalId owned() const override { return owned_; }
  LocalId count() const override { return count_; }
  Communicator& communicator() const override { return communicator_; }
  const Halo& halo() const { return halo_; }

  void apply(std::span<const double> displacements, std::span<double> forces) const override;
  void set_residual(std::span<const double> forces, std::span<const double> displacements,
                    std::span<double> residual) const override;
  void sweep(SweepDirection direction, double omega, std::span<double> forces,
             std::span<double> displacements) const override;
  void sweep_all(double omega, std::span<double> forces,
                 std::span<double> displacements) const override;
  void return_forces(std::span<double> forces) const override { halo_.add_forces(forces); }
  void clear_held(std::span<double> values) const override;

  /// forces -= K displacements of held unknowns alone; those of others are not read. Forces on
  /// ghosts are 0 on entry and on return. Collective.
  void subtract_held(std::span<const double> displacements, std::span<double> forces) const;

  /// Adds what the weak springs, `share` times as stiff, would pull with if they stood at zero, on
  /// own cells, N/m.
  void add_spring_forces(std::span<const double> displacements, std::span<double> forces,
                         double share = 1.0) const;

  const RegularRuns& regular() const { return regular_; }
  /// Of all cells that do not use the common stencil; columns of ghosts included.
  const StiffnessRows& rows() const { return rows_; }
  /// Values of the rows without springs of faces, weak springs and holds of functions that strain
  /// nothing: what the elements round the cells alone decide.
  const std::vector<double>& without_springs() const {
    return without_springs_.empty() ? rows_.value : without_springs_;
  }
  /// Own unknowns that supports hold, ascending.
  const std::vector<LocalId>& held() const { return held_; }
  /// A weak spring of an own unknown.
  struct Spring {
    LocalId unknown;
    double share;      ///< of the unknown's own stiffness
    double stiffness;  ///< Pa
  };
  /// In order of unknowns.
  const std::vector<Spring>& springs() const { return springs_; }
  /// Cells that use the common stencil.
  std::int64_t regular_cells() const { return regular_.cells(); }
  std::int64_t own_row_entries() const { return std::int64_t(rows_.value.size()); }

 private:
  /// The order of the rule: runs of regular cells and single cells (or zones), by node number.
  struct Item {
    LocalId node;
    bool run;
    std::size_t index;
    bool at_border;  ///< coupled to ghosts
  };

  void build_rows(const LocalMesh& mesh, const CellUnknowns& unknowns, ElementStiffness& elements,
                  const std::vector<LocalId>& with_rows, const CarriedCells* carried);
  /// Springs of faces, weak springs and holds, on top of the rows.
  void add_all_springs(const LocalMesh& mesh, ElementStiffness& elements,
                       const std::vector<double>& springs);
  void add_faces(const LocalMesh& mesh, ElementStiffness& elements);
  void add_springs(const std::vector<double>& springs);
  void build_groups(const LocalMesh& mesh, const CellUnknowns& unknowns,
                    const std::vector<char>& held, const std::vector<LocalId>& with_rows);
  void order_items();
  void colour_ranks(const LocalMesh& mesh);
  bool at_border(const CellGroup& group) const;
  void move_item(const Item& item, bool forward, double omega, std::span<double> forces,
                 std::span<double> displacements) const;
  void move_group(const CellGroup& group, double omega, std::span<double> forces,
                  std::span<double> displacements) const;

  Communicator& communicator_;
  Halo halo_;
  LocalId owned_ = 0;
  LocalId count_ = 0;
  RegularRuns regular_;
  StiffnessRows rows_;
  std::vector<AddedStiffness> holds_;     ///< of functions that strain nothing
  std::vector<double> without_springs_;   ///< nor holds; empty when there are none
  std::vector<std::size_t> face_places_;  ///< of the values of all faces, one after the other
  std::vector<CellGroup> groups_;
  std::vector<Item> items_;
  std::vector<LocalId> held_;
  std::vector<Spring> springs_;
  int colour_ = 0;  ///< ranks of one colour share no element
  int colours_ = 1;
};

}  // namespace cdca
