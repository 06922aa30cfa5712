// SPDX-License-Identifier: BSD-3-Clause
/// The part of the grid that one rank works on: its own cells, every element that touches them, and
/// the neighbour cells (ghosts) of those elements.
#pragma once

#include "core/mesh/block_partition.hpp"
#include "core/mesh/grid.hpp"
#include "core/mesh/node_runs.hpp"
#include "core/mesh/row_index.hpp"

#include <span>
#include <vector>

namespace cdca {

/// The cells that this rank shares with one other rank, both lists in order of global id.
struct SharedNodes {
  int rank = 0;
  std::vector<LocalId> owned;   ///< mine, ghosts there
  std::vector<LocalId> ghosts;  ///< ghosts here, owned there
};

class LocalMesh {
 public:
  LocalMesh() = default;
  LocalMesh(const StructuredGrid& grid, const BlockPartition& partition, int rank);
  /// The mesh of elements twice as large. Coarse cells live where the fine cell at the same place
  /// lives; the parents of own fine cells are ghosts as well, even without a common element.
  LocalMesh coarser() const;

  const StructuredGrid& grid() const { return grid_; }
  int rank() const { return rank_; }

  /// Own nodes have the local numbers [0, owned_nodes()), in order of global id; ghosts follow.
  LocalId owned_nodes() const { return owned_; }
  LocalId node_count() const { return LocalId(nodes_.size()); }
  bool owns(LocalId node) const { return node < owned_; }
  /// All own nodes, as long runs as there are.
  const std::vector<NodeRun>& own_runs() const { return own_runs_; }
  GridIndex node(LocalId node) const { return nodes_[std::size_t(node)]; }
  GlobalId node_id(LocalId node) const { return grid_.node(nodes_[std::size_t(node)]); }
  /// -1 when this rank does not hold it.
  LocalId find_node(GridIndex at) const { return node_index_.find(at); }

  /// Calls visit(node) for a node and those of its eight neighbours that this rank holds.
  template <class Visit>
  void for_nodes_round(LocalId node, Visit visit) const {
    const GridIndex at = this->node(node);
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const LocalId n = find_node({at.i + di, at.j + dj});
        if (n >= 0) visit(n);
      }
    }
  }

  LocalId element_count() const { return LocalId(elements_.size()); }
  GridIndex element(LocalId element) const { return elements_[std::size_t(element)]; }
  LocalId find_element(GridIndex at) const { return element_index_.find(at); }
  std::array<LocalId, 4> element_nodes(GridIndex at) const;
  /// One rank evaluates an element (stress, integrals, output): the owner of its lower left node.
  bool evaluates(GridIndex element) const { return partition_.owner(element) == rank_; }
  int owner(GridIndex node) const { return partition_.owner(node); }

  std::span<const SharedNodes> shared() const { return shared_; }

 private:
  LocalMesh(const StructuredGrid& grid, const BlockPartition& partition, int rank,
            const LocalMesh* finer);
  void collect_shared(const LocalMesh* finer);

  StructuredGrid grid_;
  BlockPartition partition_;
  int rank_ = 0;
  LocalId owned_ = 0;
  std::vector<NodeRun> own_runs_;
  std::vector<GridIndex> nodes_;
  std::vector<GridIndex> elements_;
  RowIndex node_index_;
  RowIndex element_index_;
  std::vector<SharedNodes> shared_;
};

}  // namespace cdca
