// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/block_partition.hpp"

#include "core/base/errors.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace cdca {

namespace {

int blocks_along(int nodes, int block) { return (nodes + block - 1) / block; }

int block_size(const StructuredGrid& grid, int max_blocks) {
  int block = 1;
  while (GlobalId(blocks_along(grid.nx() + 1, block)) * blocks_along(grid.ny() + 1, block) >
         max_blocks) {
    ++block;
  }
  return block;
}

/// Blocks with their eight neighbours: the cells that exchange forces.
PartitionGraph block_graph(const StructuredGrid& grid, int block,
                           const std::vector<CellWeight>& weights) {
  const int bx = blocks_along(grid.nx() + 1, block), by = blocks_along(grid.ny() + 1, block);
  PartitionGraph graph;
  for (int j = 0; j < by; ++j) {
    for (int i = 0; i < bx; ++i) {
      const int width = std::min(block, grid.nx() + 1 - i * block);
      const int height = std::min(block, grid.ny() + 1 - j * block);
      graph.weights.push_back(2 * width * height);
      for (int dj = -1; dj <= 1; ++dj) {
        for (int di = -1; di <= 1; ++di) {
          const int ni = i + di, nj = j + dj;
          const bool self = di == 0 && dj == 0;
          if (!self && ni >= 0 && nj >= 0 && ni < bx && nj < by) {
            graph.neighbours.push_back(nj * bx + ni);
          }
        }
      }
      graph.offsets.push_back(std::int64_t(graph.neighbours.size()));
    }
  }
  for (const CellWeight& w : weights) {
    graph.weights[std::size_t((w.node.j / block) * bx + w.node.i / block)] += w.extra;
  }
  return graph;
}

}  // namespace

BlockPartition::BlockPartition(const StructuredGrid& grid, int block, std::vector<int> owner)
    : block_(block),
      last_{grid.nx(), grid.ny()},
      blocks_x_(blocks_along(grid.nx() + 1, block)),
      blocks_y_(blocks_along(grid.ny() + 1, block)),
      owner_(std::move(owner)) {
  if (owner_.size() != std::size_t(blocks_x_) * std::size_t(blocks_y_)) {
    throw SolveError("a partition does not list one owner for every block of cells");
  }
}

BlockPartition BlockPartition::coarser() const {
  BlockPartition partition = *this;
  partition.stride_ *= 2;
  return partition;
}

BlockPartition::Range BlockPartition::nodes_of_block(int block, int nx, int ny) const {
  const int bi = block % blocks_x_, bj = block / blocks_x_;
  const auto up = [this](int node) { return (node + stride_ - 1) / stride_; };
  Range range{{up(bi * block_), up(bj * block_)}, {up((bi + 1) * block_), up((bj + 1) * block_)}};
  // nodes beyond the rim belong to the last block
  if (bi == blocks_x_ - 1) range.end.i = nx + 1;
  if (bj == blocks_y_ - 1) range.end.j = ny + 1;
  return range;
}

BlockPartition partition_cells(const StructuredGrid& grid, const std::vector<CellWeight>& weights,
                               Communicator& communicator, const Partitioner& partitioner,
                               int max_blocks) {
  const int block = block_size(grid, max_blocks);
  std::vector<int> owner;
  if (communicator.is_root()) {
    const PartitionGraph graph = block_graph(grid, block, weights);
    owner = communicator.size() == 1 ? std::vector<int>(graph.weights.size(), 0)
                                     : partitioner(graph, communicator.size());
  }
  Bytes bytes;
  pack(bytes, std::span<const int>(owner));
  communicator.broadcast(bytes);
  return {grid, block, unpack<int>(bytes)};
}

}  // namespace cdca
