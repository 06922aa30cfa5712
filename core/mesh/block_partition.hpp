// SPDX-License-Identifier: BSD-3-Clause
/// Which rank owns which cell. The graph that is cut is one of blocks of cells, so that no rank
/// ever holds something of the size of the grid.
#pragma once

#include "core/base/communicator.hpp"
#include "core/mesh/grid.hpp"

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

  int owner(GridIndex node) const {
    if (owner_.empty()) return 0;
    return owner_[std::size_t(node.j / block_) * std::size_t(blocks_x_) +
                  std::size_t(node.i / block_)];
  }
  int block() const { return block_; }
  int blocks_x() const { return blocks_x_; }
  int blocks_y() const { return blocks_y_; }

 private:
  int block_ = 1 << 30;
  int blocks_x_ = 1;
  int blocks_y_ = 1;
  std::vector<int> owner_;
};

/// Weight of a cell beyond that of a plain one; listed for the cells near cracks only.
struct CellWeight {
  GridIndex node;
  int extra = 0;  ///< in unknowns
};

/// Shares out the cells of a grid by `partitioner`, weighted by unknowns. The root partitions, all
/// receive. Grids of more than max_blocks cells are partitioned by blocks of several cells.
BlockPartition partition_cells(const StructuredGrid& grid, const std::vector<CellWeight>& weights,
                               Communicator& communicator, const Partitioner& partitioner,
                               int max_blocks = 40000);

}  // namespace cdca
