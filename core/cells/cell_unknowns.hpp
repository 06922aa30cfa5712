// SPDX-License-Identifier: BSD-3-Clause
/// Which unknowns each cell has, and where they stand in the vectors of the solver.
#pragma once

#include "core/base/communicator.hpp"
#include "core/base/halo.hpp"
#include "core/cells/pieces.hpp"
#include "core/cells/tip_zone.hpp"
#include "core/mesh/local_mesh.hpp"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace cdca {

/// Eight unknowns: the coefficients of the cell's four near-tip functions, x and y of each; or two,
/// those of the fields of modes I and II.
struct TipUnknowns {
  int zone = 0;  ///< index of the tip zone
  LocalId first = 0;
  LocalId count = 8;
  /// Of the functions of Eq. 5, a column for each of the cell's (orthonormal_tip_functions).
  Eigen::Matrix4d functions = Eigen::Matrix4d::Identity();
  bool has_modes() const { return count == 2; }
};

/// A cell that is not plain: several pieces, near-tip functions, or both.
struct SpecialCell {
  /// One object for as long as no crack changes round the cell.
  std::shared_ptr<const CellPieces> pieces;
  LocalId extra = 0;  ///< first unknown of piece 1; those of the other pieces follow
  std::vector<TipUnknowns> tips;
};

/// Numbers of the unknowns on this rank. Piece 0 of node n has 2n and 2n+1 for own nodes; further
/// pieces and near-tip unknowns of own cells follow, then the same for ghosts.
class CellUnknowns {
 public:
  CellUnknowns() = default;
  /// What growth has left as it was.
  struct Kept {
    const CellUnknowns& before;
    const std::vector<GlobalId>& changed;  ///< elements that other cracks run through
  };
  /// Collective: owners tell the ranks that hold ghosts of their cells what pieces these have.
  /// kept: own cells take their pieces from there; null for none.
  CellUnknowns(const LocalMesh& mesh, const ElementParts& elements,
               const std::vector<TipZone>& zones, Communicator& communicator,
               const Kept* kept = nullptr);

  LocalId owned() const { return owned_; }
  LocalId count() const { return count_; }

  /// Null for a plain cell.
  const SpecialCell* special(LocalId node) const {
    const LocalId at = place_[std::size_t(node)];
    return at < 0 ? nullptr : &cells_[std::size_t(at)];
  }
  /// All cells that are not plain, ghosts included, ascending.
  const std::vector<LocalId>& special_nodes() const { return special_nodes_; }
  /// First unknown (x; y follows) of a piece.
  LocalId of_piece(LocalId node, int piece) const;
  /// Every unknown of a cell in order: pieces, then near-tip.
  std::vector<LocalId> of_cell(LocalId node) const;
  /// The same, behind what is in the list.
  void append_cell(LocalId node, std::vector<LocalId>& unknowns) const;
  /// The piece that a part of an element round the node belongs to. slot as in CellPieces.
  int piece(LocalId node, std::size_t slot, int part) const;
  int pieces(LocalId node) const;
  std::span<const TipUnknowns> tips(LocalId node) const;

  std::vector<SharedUnknowns> shared(const LocalMesh& mesh) const;

 private:
  using Cells = std::vector<std::pair<LocalId, SpecialCell>>;  ///< ascending
  static Cells find_own(const LocalMesh& mesh, const ElementParts& elements,
                        const std::vector<TipZone>& zones, const Kept* kept);
  static void add_ghosts(const LocalMesh& mesh, Communicator& communicator, Cells& cells);
  void number(const LocalMesh& mesh, Cells cells);
  void make_tip_functions(const LocalMesh& mesh, const std::vector<TipZone>& zones);

  LocalId owned_nodes_ = 0;
  LocalId ghost_start_ = 0;  ///< first unknown of the first ghost
  LocalId owned_ = 0;
  LocalId count_ = 0;
  std::vector<LocalId> special_nodes_;
  std::vector<SpecialCell> cells_;  ///< in the same order
  std::vector<LocalId> place_;      ///< of every node among them, or -1
};

}  // namespace cdca
