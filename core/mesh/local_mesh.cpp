// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/local_mesh.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace cdca {

namespace {
bool row_by_row(const GridIndex& a, const GridIndex& b) {
  return a.j != b.j ? a.j < b.j : a.i < b.i;
}
}  // namespace

LocalMesh::LocalMesh(const StructuredGrid& grid, const BlockPartition& partition, int rank)
    : LocalMesh(grid, partition, rank, nullptr) {}

LocalMesh::LocalMesh(const StructuredGrid& grid, const BlockPartition& partition, int rank,
                     const LocalMesh* finer)
    : grid_(grid), partition_(partition), rank_(rank) {
  collect_owned();
  collect_elements();
  collect_ghosts(finer);
  collect_shared(finer);
}

LocalMesh LocalMesh::coarser() const {
  return LocalMesh(grid_.coarser(), partition_.coarser(), rank_, this);
}

void LocalMesh::collect_owned() {
  const auto take = [this](GridIndex first, GridIndex end) {
    for (int j = first.j; j < end.j; ++j) {
      for (int i = first.i; i < end.i; ++i) nodes_.push_back({i, j});
    }
  };
  if (partition_.is_whole() && rank_ == 0) take({0, 0}, {grid_.nx() + 1, grid_.ny() + 1});
  for (int block = 0; block < partition_.block_count(); ++block) {
    if (partition_.owner_of_block(block) != rank_) continue;
    const auto range = partition_.nodes_of_block(block, grid_.nx(), grid_.ny());
    take(range.first, range.end);
  }
  std::sort(nodes_.begin(), nodes_.end(), row_by_row);
  owned_ = LocalId(nodes_.size());
}

void LocalMesh::collect_elements() {
  // an element is taken by its first own corner, so each comes once
  for (LocalId n = 0; n < owned_; ++n) {
    for (const GridIndex e : grid_.elements_round(node(n))) {
      if (!grid_.has_element(e)) continue;
      for (const GridIndex corner : {GridIndex{e.i, e.j}, GridIndex{e.i + 1, e.j},
                                     GridIndex{e.i, e.j + 1}, GridIndex{e.i + 1, e.j + 1}}) {
        if (partition_.owner(corner) != rank_) continue;
        if (corner == node(n)) elements_.push_back(e);
        break;
      }
    }
  }
  std::sort(elements_.begin(), elements_.end(), row_by_row);
  for (std::size_t k = 0; k < elements_.size(); ++k) element_index_.add(elements_[k], LocalId(k));
  element_index_.finish();
}

namespace {

/// The coarse nodes from which a fine node takes its displacement.
std::array<GridIndex, 4> parents_of(GridIndex fine) {
  const int i = fine.i / 2, j = fine.j / 2, right = (fine.i + 1) / 2, above = (fine.j + 1) / 2;
  return {{{i, j}, {right, j}, {i, above}, {right, above}}};
}

}  // namespace

void LocalMesh::collect_ghosts(const LocalMesh* finer) {
  std::vector<GridIndex> ghosts;
  if (finer && !partition_.is_whole()) {
    for (LocalId n = 0; n < finer->owned_nodes(); ++n) {
      for (const GridIndex parent : parents_of(finer->node(n))) {
        if (partition_.owner(parent) != rank_) ghosts.push_back(parent);
      }
    }
  }
  for (const GridIndex e : elements_) {
    for (const GridIndex corner : grid_.corners(e)) {
      if (partition_.owner(corner) != rank_) ghosts.push_back(corner);
    }
  }
  std::sort(ghosts.begin(), ghosts.end(), row_by_row);
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  nodes_.insert(nodes_.end(), ghosts.begin(), ghosts.end());
  for (std::size_t k = 0; k < nodes_.size(); ++k) node_index_.add(nodes_[k], LocalId(k));
  node_index_.finish();
}

void LocalMesh::collect_shared(const LocalMesh* finer) {
  // whoever has an element with one of my cells and one of its own holds both: the relation is
  // symmetric, so both sides find the same lists without a message
  std::map<int, std::set<LocalId>> owned, ghosts;
  for (const GridIndex e : elements_) {
    const auto corners = grid_.corners(e);
    for (const GridIndex ghost : corners) {
      const int other = partition_.owner(ghost);
      if (other == rank_) continue;
      ghosts[other].insert(find_node(ghost));
      for (const GridIndex mine : corners) {
        if (partition_.owner(mine) == rank_) owned[other].insert(find_node(mine));
      }
    }
  }
  if (finer && !partition_.is_whole()) {
    // the same for a parent and its children
    for (LocalId n = 0; n < finer->owned_nodes(); ++n) {
      for (const GridIndex parent : parents_of(finer->node(n))) {
        const int other = partition_.owner(parent);
        if (other != rank_) ghosts[other].insert(find_node(parent));
      }
    }
    for (LocalId n = 0; n < owned_; ++n) {
      const GridIndex at = node(n);
      for (int j = 2 * at.j - 1; j <= 2 * at.j + 1; ++j) {
        for (int i = 2 * at.i - 1; i <= 2 * at.i + 1; ++i) {
          if (i < 0 || j < 0 || i > finer->grid().nx() || j > finer->grid().ny()) continue;
          const int other = finer->owner({i, j});
          if (other != rank_) owned[other].insert(n);
        }
      }
    }
  }
  std::set<int> ranks;
  for (const auto& [rank, nodes] : ghosts) ranks.insert(rank);
  for (const auto& [rank, nodes] : owned) ranks.insert(rank);
  for (const int rank : ranks) {
    SharedNodes shared;
    shared.rank = rank;
    shared.ghosts.assign(ghosts[rank].begin(), ghosts[rank].end());
    shared.owned.assign(owned[rank].begin(), owned[rank].end());
    shared_.push_back(std::move(shared));
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
