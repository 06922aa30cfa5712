// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/cell_stiffness.hpp"

#include <algorithm>
#include <map>

namespace cdca {

namespace {

/// A cell is regular when its support is whole, untouched by cracks and material of this rank, and
/// none of its neighbours has more than its two plain unknowns; and no support holds it.
bool is_regular(const BasisContext& context, const std::vector<char>& held, LocalId node) {
  const GridIndex at = context.mesh.node(node);
  const auto unknown = std::size_t(context.unknowns.of_piece(node, 0));
  if (held[unknown] || held[unknown + 1]) return false;
  for (const GridIndex e : context.mesh.grid().elements_round(at)) {
    if (!context.mesh.grid().has_element(e) || context.cuts.touched(e)) return false;
  }
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      const LocalId neighbour = context.mesh.find_node({at.i + di, at.j + dj});
      if (!context.mesh.owns(neighbour) || context.unknowns.special(neighbour)) return false;
    }
  }
  return true;
}

struct Entry {
  LocalId row;
  LocalId column;
  double value;
};

StiffnessRows compress(std::vector<Entry>& entries) {
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  StiffnessRows rows;
  for (const Entry& e : entries) {
    const bool new_row = rows.unknown.empty() || rows.unknown.back() != e.row;
    if (new_row) {
      rows.unknown.push_back(e.row);
      rows.start.push_back(rows.start.back());
    }
    if (!new_row && rows.column.back() == e.column) {
      rows.value.back() += e.value;
    } else {
      rows.column.push_back(e.column);
      rows.value.push_back(e.value);
      ++rows.start.back();
    }
  }
  return rows;
}

}  // namespace

std::ptrdiff_t StiffnessRows::find(LocalId u) const {
  const auto it = std::lower_bound(unknown.begin(), unknown.end(), u);
  return it != unknown.end() && *it == u ? it - unknown.begin() : -1;
}

CellStiffness::CellStiffness(const BasisContext& context, const ElasticMatrix& elastic,
                             const std::vector<char>& held, const std::vector<char>& loose,
                             StiffnessCache& cache, Communicator& communicator)
    : communicator_(communicator),
      halo_(communicator, context.unknowns.shared(context.mesh)),
      owned_(context.unknowns.owned()),
      count_(context.unknowns.count()) {
  const LocalMesh& mesh = context.mesh;
  std::vector<char> regular(std::size_t(mesh.node_count()), 0);
  for (LocalId n = 0; n < mesh.owned_nodes(); ++n)
    regular[std::size_t(n)] = is_regular(context, held, n);
  regular_ = RegularRuns(mesh, regular, plain_stiffness(mesh.grid().element_size(), elastic));
  build_rows(context, elastic, regular, cache);
  if (!loose.empty()) add_springs(loose);
  build_groups(context, held, regular);
  order_items();
  colour_ranks(mesh);
  for (LocalId u = 0; u < owned_; ++u) {
    if (held[std::size_t(u)]) held_.push_back(u);
  }
}

void CellStiffness::build_rows(const BasisContext& context, const ElasticMatrix& elastic,
                               const std::vector<char>& regular, StiffnessCache& cache) {
  const LocalMesh& mesh = context.mesh;
  const auto plain = plain_stiffness(mesh.grid().element_size(), elastic);
  std::vector<char> wanted(std::size_t(count_), 0);
  for (LocalId n = 0; n < mesh.node_count(); ++n) {
    if (regular[std::size_t(n)]) continue;
    for (const LocalId u : context.unknowns.of_cell(n)) wanted[std::size_t(u)] = 1;
  }
  std::vector<Entry> entries;
  const auto add = [&](LocalId row, LocalId column, double value) {
    // what ghosts do to ghosts is their owners' business
    if (wanted[std::size_t(row)] && (row < owned_ || column < owned_)) {
      entries.push_back({row, column, value});
    }
  };
  for (LocalId e = 0; e < mesh.element_count(); ++e) {
    const GridIndex element = mesh.element(e);
    const auto nodes = mesh.element_nodes(element);
    bool all_regular = true, special = context.cuts.touched(element);
    for (const LocalId n : nodes) {
      all_regular = all_regular && regular[std::size_t(n)];
      special = special || context.unknowns.special(n);
    }
    if (all_regular) continue;
    if (!special) {
      for (std::size_t a = 0; a < 8; ++a) {
        const LocalId row = context.unknowns.of_piece(nodes[a / 2], 0) + LocalId(a % 2);
        for (std::size_t b = 0; b < 8; ++b) {
          add(row, context.unknowns.of_piece(nodes[b / 2], 0) + LocalId(b % 2),
              plain(Eigen::Index(a), Eigen::Index(b)));
        }
      }
      continue;
    }
    for (int part = 0; part < context.cuts.parts(element); ++part) {
      const PartStiffness own = cache.of(context, element, part, elastic);
      for (std::size_t a = 0; a < own.unknowns.size(); ++a) {
        for (std::size_t b = 0; b < own.unknowns.size(); ++b) {
          add(own.unknowns[a], own.unknowns[b], own.matrix(Eigen::Index(a), Eigen::Index(b)));
        }
      }
    }
  }
  rows_ = compress(entries);
}

void CellStiffness::add_springs(const std::vector<char>& loose) {
  constexpr double weak = 1e-6;  // of the unknown's own stiffness
  for (std::size_t r = 0; r < rows_.unknown.size(); ++r) {
    if (!loose[std::size_t(rows_.unknown[r])] || rows_.unknown[r] >= owned_) continue;
    for (std::size_t k = rows_.start[r]; k < rows_.start[r + 1]; ++k) {
      if (rows_.column[k] == rows_.unknown[r]) rows_.value[k] *= 1 + weak;
    }
  }
}

void CellStiffness::build_groups(const BasisContext& context, const std::vector<char>& held,
                                 const std::vector<char>& regular) {
  // cells of one zone form a group with the number of the zone; all others stand alone
  std::map<std::pair<int, LocalId>, std::vector<LocalId>> members;
  for (LocalId n = 0; n < context.mesh.owned_nodes(); ++n) {
    if (regular[std::size_t(n)]) continue;
    const auto tips = context.unknowns.tips(n);
    const auto key = tips.empty() ? std::pair<int, LocalId>(-1, n)
                                  : std::pair<int, LocalId>(tips.front().zone, -1);
    members[key].push_back(n);
  }
  std::vector<LocalId> place(std::size_t(count_), -1);
  for (const auto& [key, nodes] : members) {
    std::vector<LocalId> unknowns;
    std::vector<std::size_t> rows;
    for (const LocalId n : nodes) {
      for (const LocalId u : context.unknowns.of_cell(n)) {
        const std::ptrdiff_t row = rows_.find(u);
        if (held[std::size_t(u)] || row < 0) continue;
        place[std::size_t(u)] = LocalId(unknowns.size());
        unknowns.push_back(u);
        rows.push_back(std::size_t(row));
      }
    }
    std::vector<Eigen::Triplet<double>> triplets;
    for (std::size_t a = 0; a < rows.size(); ++a) {
      for (std::size_t k = rows_.start[rows[a]]; k < rows_.start[rows[a] + 1]; ++k) {
        const LocalId b = place[std::size_t(rows_.column[k])];
        if (b >= 0) triplets.emplace_back(int(a), b, rows_.value[k]);
      }
    }
    Eigen::SparseMatrix<double> matrix(Eigen::Index(rows.size()), Eigen::Index(rows.size()));
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    for (const LocalId u : unknowns) place[std::size_t(u)] = -1;
    if (!unknowns.empty())
      groups_.emplace_back(nodes.front(), std::move(unknowns), std::move(rows), matrix);
  }
}

void CellStiffness::order_items() {
  for (std::size_t r = 0; r < regular_.runs().size(); ++r) {
    items_.push_back({regular_.runs()[r].node, true, r, false});
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    items_.push_back({groups_[g].first_node(), false, g, at_border(groups_[g])});
  }
  std::sort(items_.begin(), items_.end(),
            [](const Item& a, const Item& b) { return a.node < b.node; });
}

void CellStiffness::apply(std::span<const double> x, std::span<double> forces) const {
  std::fill(forces.begin(), forces.end(), 0.0);
  regular_.apply(x, forces);
  for (std::size_t r = 0; r < rows_.unknown.size(); ++r) {
    double sum = 0.0;
    for (std::size_t k = rows_.start[r]; k < rows_.start[r + 1]; ++k) {
      if (rows_.column[k] < owned_) sum += rows_.value[k] * x[std::size_t(rows_.column[k])];
    }
    forces[std::size_t(rows_.unknown[r])] = sum;
  }
  halo_.add_forces(forces);
}

void CellStiffness::move_group(const CellGroup& group, double omega, std::span<double> forces,
                               std::span<double> displacements) const {
  const auto size = Eigen::Index(group.unknowns().size());
  Eigen::VectorXd force(size), move(size);
  for (Eigen::Index a = 0; a < size; ++a) {
    force[a] = omega * forces[std::size_t(group.unknowns()[std::size_t(a)])];
  }
  group.solve(force, move);
  for (Eigen::Index a = 0; a < size; ++a) {
    displacements[std::size_t(group.unknowns()[std::size_t(a)])] += move[a];
    const std::size_t row = group.rows()[std::size_t(a)];
    for (std::size_t k = rows_.start[row]; k < rows_.start[row + 1]; ++k) {
      forces[std::size_t(rows_.column[k])] -= rows_.value[k] * move[a];
    }
  }
}

bool CellStiffness::at_border(const CellGroup& group) const {
  for (const std::size_t row : group.rows()) {
    for (std::size_t k = rows_.start[row]; k < rows_.start[row + 1]; ++k) {
      if (rows_.column[k] >= owned_) return true;
    }
  }
  return false;
}

void CellStiffness::colour_ranks(const LocalMesh& mesh) {
  struct Border {
    int rank;
    int neighbour;
  };
  std::vector<Border> mine;
  for (const SharedNodes& shared : mesh.shared())
    mine.push_back({communicator_.rank(), shared.rank});
  const auto borders = communicator_.agree(mine, [](const Border& a, const Border& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.neighbour < b.neighbour;
  });
  std::vector<int> colour(std::size_t(communicator_.size()), 0);
  for (int rank = 0; rank < communicator_.size(); ++rank) {
    std::vector<char> taken(colour.size() + 1, 0);
    for (const Border& b : borders) {
      if (b.rank == rank && b.neighbour < rank)
        taken[std::size_t(colour[std::size_t(b.neighbour)])] = 1;
    }
    int& own = colour[std::size_t(rank)];
    while (taken[std::size_t(own)]) ++own;
    colours_ = std::max(colours_, own + 1);
  }
  colour_ = colour[std::size_t(communicator_.rank())];
}

void CellStiffness::move_item(const Item& item, bool forward, double omega,
                              std::span<double> forces, std::span<double> displacements) const {
  if (item.run) {
    regular_.sweep(regular_.runs()[item.index], forward, omega, forces, displacements);
  } else {
    move_group(groups_[item.index], omega, forces, displacements);
  }
}

void CellStiffness::sweep(SweepDirection direction, double omega, std::span<double> forces,
                          std::span<double> displacements) const {
  const bool forward = direction == SweepDirection::forward;
  for (std::size_t k = 0; k < items_.size(); ++k) {
    move_item(items_[forward ? k : items_.size() - 1 - k], forward, omega, forces, displacements);
  }
}

void CellStiffness::sweep_all(double omega, std::span<double> forces,
                              std::span<double> displacements) const {
  for (int colour = 0; colour < colours_; ++colour) {
    for (const Item& item : items_) {
      // cells inside a rank are not coupled to those of others: the last colour's turn is theirs
      const bool now = item.at_border ? colour == colour_ : colour + 1 == colours_;
      if (now) move_item(item, true, omega, forces, displacements);
    }
    halo_.add_forces(forces);
  }
}

void CellStiffness::clear_held(std::span<double> values) const {
  for (const LocalId u : held_) values[std::size_t(u)] = 0.0;
}

}  // namespace cdca
