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
    : grid_(grid), partition_(partition), rank_(rank) {
  collect_owned();
  collect_elements();
  collect_ghosts();
  collect_shared();
}

void LocalMesh::collect_owned() {
  const int block = partition_.block();
  for (int bj = 0; bj < partition_.blocks_y(); ++bj) {
    for (int bi = 0; bi < partition_.blocks_x(); ++bi) {
      if (partition_.owner({bi * block, bj * block}) != rank_) continue;
      for (int j = bj * block; j < std::min((bj + 1) * block, grid_.ny() + 1); ++j) {
        for (int i = bi * block; i < std::min((bi + 1) * block, grid_.nx() + 1); ++i) {
          nodes_.push_back({i, j});
        }
      }
      if (block > grid_.nx() && block > grid_.ny()) break;
    }
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

void LocalMesh::collect_ghosts() {
  std::vector<GridIndex> ghosts;
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

void LocalMesh::collect_shared() {
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
  for (const auto& [rank, nodes] : ghosts) {
    SharedNodes shared;
    shared.rank = rank;
    shared.ghosts.assign(nodes.begin(), nodes.end());
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
