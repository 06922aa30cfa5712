// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/local_mesh.hpp"

#include "core/base/sort_once.hpp"
#include "core/mesh/row_spans.hpp"

#include <algorithm>
#include <map>

namespace cdca {

namespace {

RowSpans nodes_of_rank(const StructuredGrid& grid, const BlockPartition& partition, int rank) {
  RowSpans nodes;
  if (partition.is_whole() && rank == 0) {
    for (int j = 0; j <= grid.ny(); ++j) nodes.add(j, 0, grid.nx() + 1);
  }
  for (int block = 0; block < partition.block_count(); ++block) {
    if (partition.owner_of_block(block) != rank) continue;
    const auto range = partition.nodes_of_block(block, grid.nx(), grid.ny());
    for (int j = range.first.j; j < range.end.j; ++j) nodes.add(j, range.first.i, range.end.i);
  }
  nodes.sort();
  return nodes;
}

RowSpans elements_round(const StructuredGrid& grid, const RowSpans& nodes) {
  RowSpans elements;
  nodes.for_each([&](int row, const RowSpans::Span& span) {
    for (int j = row - 1; j <= std::min(row, grid.ny() - 1); ++j)
      elements.add(j, std::max(0, span.first - 1), std::min(grid.nx(), span.end));
  });
  elements.sort();
  return elements;
}

/// The coarse nodes from which a fine node takes its displacement.
std::array<GridIndex, 4> parents_of(GridIndex fine) {
  const int i = fine.i / 2, j = fine.j / 2, right = (fine.i + 1) / 2, above = (fine.j + 1) / 2;
  return {{{i, j}, {right, j}, {i, above}, {right, above}}};
}

/// Lists the places and gives them the numbers that follow those already there.
void append(const RowSpans& places, std::vector<GridIndex>& list, RowIndex& index) {
  std::size_t count = list.size();
  places.for_each([&](int, const RowSpans::Span& s) { count += std::size_t(s.end - s.first); });
  list.reserve(count);
  places.for_each([&](int row, const RowSpans::Span& span) {
    index.add({span.first, row}, span.end - span.first, LocalId(list.size()));
    for (int i = span.first; i < span.end; ++i) list.push_back({i, row});
  });
}

}  // namespace

LocalMesh::LocalMesh(const StructuredGrid& grid, const BlockPartition& partition, int rank)
    : LocalMesh(grid, partition, rank, nullptr) {}

LocalMesh::LocalMesh(const StructuredGrid& grid, const BlockPartition& partition, int rank,
                     const LocalMesh* finer)
    : grid_(grid), partition_(partition), rank_(rank) {
  const RowSpans own = nodes_of_rank(grid_, partition_, rank_);
  const RowSpans elements = elements_round(grid_, own);
  append(elements, elements_, element_index_);
  RowSpans held;
  elements.for_each([&](int row, const RowSpans::Span& span) {
    for (const int j : {row, row + 1}) held.add(j, span.first, span.end + 1);
  });
  if (finer) {
    nodes_of_rank(finer->grid(), finer->partition_, rank_)
        .for_each([&](int row, const RowSpans::Span& span) {
          for (const int j : {row / 2, (row + 1) / 2})
            held.add(j, span.first / 2, span.end / 2 + 1);
        });
  }
  held.sort();
  append(own, nodes_, node_index_);
  owned_ = LocalId(nodes_.size());
  LocalId next = 0;
  own.for_each([&](int row, const RowSpans::Span& span) {
    own_runs_.push_back({next, span.end - span.first, {span.first, row}});
    next = own_runs_.back().end();
  });
  append(held.without(own), nodes_, node_index_);
  node_index_.finish();
  element_index_.finish();
  collect_shared(finer);
}

LocalMesh LocalMesh::coarser() const {
  return LocalMesh(grid_.coarser(), partition_.coarser(), rank_, this);
}

void LocalMesh::collect_shared(const LocalMesh* finer) {
  // whoever has an element with one of my cells and one of its own holds both: the relation is
  // symmetric, so both sides find the same lists without a message
  std::map<int, SharedNodes> shared;
  for (LocalId ghost = owned_; ghost < node_count(); ++ghost) {
    SharedNodes& with = shared[partition_.owner(node(ghost))];
    with.ghosts.push_back(ghost);
    for (const GridIndex e : grid_.elements_round(node(ghost))) {
      if (find_element(e) < 0) continue;
      for (const LocalId n : element_nodes(e)) {
        if (owns(n)) with.owned.push_back(n);
      }
    }
  }
  if (finer) {
    // the same for a parent and its children: those of own parents that others own are ghosts
    for (LocalId child = finer->owned_nodes(); child < finer->node_count(); ++child) {
      for (const GridIndex parent : parents_of(finer->node(child))) {
        if (partition_.owner(parent) == rank_)
          shared[finer->owner(finer->node(child))].owned.push_back(find_node(parent));
      }
    }
  }
  for (auto& [rank, with] : shared) {
    with.rank = rank;
    sort_once(with.owned);
    shared_.push_back(std::move(with));
  }
}

std::array<LocalId, 4> LocalMesh::element_nodes(GridIndex at) const {
  const LocalId lower = find_node({at.i, at.j}), upper = find_node({at.i, at.j + 1});
  // neighbours in a row have consecutive numbers unless an owner border lies between them
  const auto next = [this](LocalId n, GridIndex g) {
    const bool follows = n + 1 < node_count() && nodes_[std::size_t(n + 1)] == g;
    return follows ? n + 1 : find_node(g);
  };
  return {lower, next(lower, {at.i + 1, at.j}), next(upper, {at.i + 1, at.j + 1}), upper};
}

}  // namespace cdca
