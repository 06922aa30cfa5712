// SPDX-License-Identifier: BSD-3-Clause
/// Which rank owns which cell. The graph that is cut is one of blocks of cells, so that no rank
/// ever holds something of the size of the grid.
#pragma once

#include "core/base/communicator.hpp"
#include "core/mesh/grid.hpp"

#include <algorithm>
#include <functional>
#include <vector>

namespace cdca {

/// The owner of every cell (node), constant on square blocks of cells.
class BlockPartition {
 public:
  /// All cells on rank 0.
  BlockPartition() = default;
  /// owner_of_block: one rank per block, blocks numbered row by row.
  BlockPartition(const StructuredGrid& grid, int block, std::vector<int> owner_of_block);

  /// Of the grid that coarser() gives: its nodes belong to whoever owns the node at the same place
  /// here, or, beyond the rim, the nearest one.
  BlockPartition coarser() const;

  int owner(GridIndex node) const {
    if (owner_.empty()) return 0;
    const int i = std::min(node.i * stride_, last_.i), j = std::min(node.j * stride_, last_.j);
    return owner_[std::size_t(j / block_) * std::size_t(blocks_x_) + std::size_t(i / block_)];
  }
  int block() const { return block_; }
  int blocks_x() const { return blocks_x_; }
  int blocks_y() const { return blocks_y_; }
  /// All cells belong to one rank.
  bool is_whole() const { return owner_.empty(); }
  int block_count() const { return int(owner_.size()); }
  int owner_of_block(int block) const { return owner_[std::size_t(block)]; }
  /// The nodes of a block in a grid of nx x ny elements: from first to just before end.
  struct Range {
    GridIndex first, end;
  };
  Range nodes_of_block(int block, int nx, int ny) const;

 private:
  int block_ = 1 << 30;
  int stride_ = 1;    ///< nodes of the finest grid from one node of this one to the next
  GridIndex last_{};  ///< node of the finest grid
  int blocks_x_ = 1;
  int blocks_y_ = 1;
  std::vector<int> owner_;
};

/// Weight of a cell beyond that of a plain one; listed for the cells near cracks only.
struct CellWeight {
  GridIndex node;
  int extra = 0;  ///< in unknowns
};

/// Enough blocks for even shares, and few enough to be partitioned in a small part of the set-up.
constexpr int most_blocks(int ranks) { return std::clamp(1000 * ranks, 2000, 8000); }

/// Shares out the cells of a grid by `partitioner`, weighted by unknowns. The root partitions, all
/// receive. Grids of more than max_blocks cells are partitioned by blocks of several cells.
BlockPartition partition_cells(const StructuredGrid& grid, const std::vector<CellWeight>& weights,
                               Communicator& communicator, const Partitioner& partitioner,
                               int max_blocks);

}  // namespace cdca
