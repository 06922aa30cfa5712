// SPDX-License-Identifier: BSD-3-Clause
/// What growing cracks and turning springs leave as it was on one scale.
#pragma once

#include "core/cells/cell_stiffness.hpp"

#include <vector>

namespace cdca {

/// Elements of a scale that are not what they were; each list in order of id.
struct ChangedElements {
  std::vector<GlobalId> cuts;       ///< other cracks run through them
  std::vector<GlobalId> functions;  ///< other functions act on them: `cuts` and round tips
  std::vector<GlobalId> turned;     ///< springs of faces are others
};

/// Elements through which cracks do not run as they did, in order of id.
std::vector<GlobalId> changed_cuts(const ElementCuts& before, const ElementCuts& after);

/// Adds the elements on which near-tip functions are not what they were.
std::vector<GlobalId> with_changed_zones(std::vector<GlobalId> elements,
                                         const std::vector<TipZone>& before,
                                         const std::vector<TipZone>& after);

/// Adds the elements that faces couple to these: springs there answer to the functions of both
/// sides.
std::vector<GlobalId> with_other_sides(std::vector<GlobalId> elements, const ElementCuts& cuts);

/// The elements twice as large that hold them, in order of id.
std::vector<GlobalId> parents_of(const std::vector<GlobalId>& elements, const StructuredGrid& grid);

/// The cells of a scale before and after cracks have grown or springs of faces have turned: which
/// stiffness can be taken over, and under what numbers. Borrows the cells of before.
class CarriedCells {
 public:
  /// held, springs: of the new unknowns, as for CellStiffness.
  CarriedCells(const LocalMesh& mesh, const CellUnknowns& unknowns_before,
               const CellStiffness& before, const CellUnknowns& unknowns, ChangedElements changed,
               const std::vector<char>& held, const std::vector<double>& springs);

  /// All that the stiffness of a cell depends on is what it was,
  bool same(LocalId node) const { return same_[std::size_t(node)] != 0; }
  /// but perhaps for springs and holds.
  bool same_rows(LocalId node) const { return same_rows_[std::size_t(node)] != 0; }
  /// The number of an old unknown of a cell that has the unknowns that it had. Numbers keep their
  /// order. Of other cells the two plain unknowns have one, and the rest -1.
  LocalId now(LocalId unknown) const {
    return unknown < plain_ ? unknown : now_[std::size_t(unknown - plain_)];
  }
  const CellStiffness& before() const { return before_; }
  const ChangedElements& changed() const { return changed_; }

 private:
  /// Corners of elements that have changed differ.
  void mark_changed(const LocalMesh& mesh, const CellUnknowns& unknowns);
  /// Numbers of unknowns; cells that have others, or are held otherwise, differ, and so do those
  /// round them; cells with other weak springs differ, but not in their rows.
  void carry_unknowns(const LocalMesh& mesh, const CellUnknowns& unknowns_before,
                      const CellUnknowns& unknowns, const std::vector<char>& held,
                      const std::vector<double>& springs);
  void carry_plain(const LocalMesh& mesh, const CellUnknowns& unknowns_before,
                   const CellUnknowns& unknowns, const std::vector<char>& held,
                   const std::vector<double>& springs);
  void mark_turned(const LocalMesh& mesh);
  /// Cells of a tip zone are the same together, or none is.
  void mark_zones(const CellUnknowns& unknowns);
  void differs_round(const LocalMesh& mesh, LocalId node);

  const CellStiffness& before_;
  ChangedElements changed_;
  std::vector<char> same_rows_, same_;  ///< by node
  LocalId plain_;  ///< so many unknowns come first: the plain ones of own cells, always the same
  std::vector<LocalId> now_;  ///< of the others
};

}  // namespace cdca
