// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/cell_stiffness.hpp"

#include "core/base/first_failure.hpp"
#include "core/base/marked.hpp"
#include "core/cells/kept_rows.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace cdca {

namespace {

/// A cell is regular when its support is whole, untouched by cracks and material of this rank, and
/// none of its neighbours has more than its two plain unknowns; and no support holds it. All others
/// of this rank, ghosts included, have rows of their own; ascending.
std::vector<LocalId> cells_with_rows(const LocalMesh& mesh, const std::vector<GlobalId>& special,
                                     const std::vector<LocalId>& held,
                                     const std::vector<GlobalId>& own_rows) {
  const StructuredGrid& grid = mesh.grid();
  std::vector<char> with_rows(std::size_t(mesh.node_count()), 0);
  const auto add = [&](LocalId n) { with_rows[std::size_t(n)] = 1; };
  for (const NodeRun& run : mesh.own_runs()) {
    if (run.at.j == 0 || run.at.j == grid.ny())
      std::fill_n(with_rows.begin() + run.first, run.count, char(1));
    if (run.at.i == 0) add(run.first);
    if (run.end_column() > grid.nx()) add(run.end() - 1);
  }
  for (const LocalId u : held) {
    // cells with further unknowns are special
    if (mesh.owns(u / 2)) add(u / 2);
  }
  for (LocalId ghost = mesh.owned_nodes(); ghost < mesh.node_count(); ++ghost)
    mesh.for_nodes_round(ghost, add);
  for (const GlobalId id : special) {
    for (const LocalId n : mesh.element_nodes(grid.element_index(id))) add(n);
  }
  for (const GlobalId id : own_rows) {
    const LocalId n = mesh.find_node(grid.node_index(id));
    if (n >= 0) add(n);
  }
  return marked(with_rows);
}

/// The elements of this rank round some nodes, in order of id.
std::vector<GridIndex> elements_round(const LocalMesh& mesh, const std::vector<char>& nodes) {
  std::vector<char> round(std::size_t(mesh.element_count()), 0);
  for (const LocalId n : marked(nodes)) {
    for (const GridIndex e : mesh.grid().elements_round(mesh.node(n))) {
      const LocalId found = mesh.find_element(e);
      if (found >= 0) round[std::size_t(found)] = 1;
    }
  }
  std::vector<GridIndex> elements;
  for (const LocalId e : marked(round)) elements.push_back(mesh.element(e));
  return elements;
}

}  // namespace

CellStiffness::CellStiffness(const LocalMesh& mesh, const CellUnknowns& unknowns,
                             ElementStiffness& elements, const std::vector<char>& held,
                             const std::vector<double>& springs,
                             const std::vector<GlobalId>& own_rows, Sweeps sweeps,
                             Communicator& communicator, const CarriedCells* carried)
    : communicator_(communicator),
      halo_(communicator, unknowns.shared(mesh)),
      owned_(unknowns.owned()),
      count_(unknowns.count()) {
  held_ = marked({held.data(), std::size_t(owned_)});
  const auto with_rows = cells_with_rows(mesh, elements.special(), held_, own_rows);
  regular_ = RegularRuns(mesh, runs_without(mesh.own_runs(), with_rows), elements.plain());
  build_rows(mesh, unknowns, elements, with_rows, carried);
  holds_ = holds_of_idle_functions(mesh, unknowns, rows_, communicator);
  add_all_springs(mesh, elements, springs);
  if (sweeps == Sweeps::one_after_the_other) {
    fail_together(communicator, [&] { build_groups(mesh, unknowns, held, with_rows); });
    order_items();
    colour_ranks(mesh);
  }
}

void CellStiffness::turn_springs(const LocalMesh& mesh, ElementStiffness& elements,
                                 const std::vector<double>& springs) {
  if (!without_springs_.empty()) rows_.value = without_springs_;
  springs_.clear();
  add_all_springs(mesh, elements, springs);
}

void CellStiffness::add_all_springs(const LocalMesh& mesh, ElementStiffness& elements,
                                    const std::vector<double>& springs) {
  if (!springs.empty() || !holds_.empty()) without_springs_ = rows_.value;
  for (const AddedStiffness& h : holds_) rows_.value[h.place] += h.value;
  add_faces(mesh, elements);
  if (!springs.empty()) add_springs(springs);
}

void CellStiffness::build_rows(const LocalMesh& mesh, const CellUnknowns& unknowns,
                               ElementStiffness& elements, const std::vector<LocalId>& with_rows,
                               const CarriedCells* carried) {
  KeptRows kept(carried);
  std::vector<char> wanted(std::size_t(count_), 0), anew(std::size_t(mesh.node_count()), 0);
  std::vector<LocalId> own;
  for (const LocalId n : with_rows) {
    own.clear();
    unknowns.append_cell(n, own);
    if (kept.keep(n, own)) continue;
    anew[std::size_t(n)] = 1;
    for (const LocalId u : own) wanted[std::size_t(u)] = 1;
  }
  RowSum sum;
  const auto& special = elements.special();
  auto next_special = special.begin();
  for (const GridIndex element : elements_round(mesh, anew)) {
    const GlobalId id = mesh.grid().element(element);
    while (next_special != special.end() && *next_special < id) ++next_special;
    if (next_special == special.end() || *next_special != id) {
      std::array<LocalId, 8> of_nodes;
      std::size_t k = 0;
      for (const LocalId n : mesh.element_nodes(element)) {
        of_nodes[k++] = unknowns.of_piece(n, 0);
        of_nodes[k++] = unknowns.of_piece(n, 0) + 1;
      }
      sum.refer_to(of_nodes, elements.plain());
      continue;
    }
    for (PartStiffness& own_part : elements.parts(element))
      sum.add(own_part.unknowns, std::move(own_part.matrix));
    for (const PartStiffness* face : elements.faces(element)) sum.make_places(face->unknowns);
  }
  rows_ = kept.with(sum.rows(wanted, owned_));
}

void CellStiffness::add_faces(const LocalMesh& mesh, ElementStiffness& elements) {
  std::size_t next = 0;
  for (const GlobalId id : elements.special()) {
    for (const PartStiffness* face : elements.faces(mesh.grid().element_index(id))) {
      if (without_springs_.empty()) without_springs_ = rows_.value;
      if (next == face_places_.size()) rows_.append_places(face->unknowns, owned_, face_places_);
      for (const double value : face->matrix.reshaped()) {
        const std::size_t place = face_places_[next++];
        if (place != StiffnessRows::nowhere) rows_.value[place] += value;
      }
    }
  }
}

void CellStiffness::add_springs(const std::vector<double>& springs) {
  for (std::size_t r = 0; r < rows_.unknown.size(); ++r) {
    const LocalId u = rows_.unknown[r];
    if (u >= owned_ || springs[std::size_t(u)] == 0.0) continue;
    for (std::size_t k = rows_.start[r]; k < rows_.start[r + 1]; ++k) {
      if (rows_.column[k] != u) continue;
      // faces that turn must not change them
      const double share = springs[std::size_t(u)];
      springs_.push_back({u, share, share * without_springs_[k]});
      rows_.value[k] += springs_.back().stiffness;
    }
  }
}

void CellStiffness::add_spring_forces(std::span<const double> displacements,
                                      std::span<double> forces, double share) const {
  for (const Spring& s : springs_)
    forces[std::size_t(s.unknown)] += share * s.stiffness * displacements[std::size_t(s.unknown)];
}

void CellStiffness::build_groups(const LocalMesh& mesh, const CellUnknowns& unknowns,
                                 const std::vector<char>& held,
                                 const std::vector<LocalId>& with_rows) {
  // cells of one zone form a group with the number of the zone; all others stand alone
  std::map<std::pair<int, LocalId>, std::vector<LocalId>> members;
  for (const LocalId n : with_rows) {
    if (!mesh.owns(n)) break;
    const auto tips = unknowns.tips(n);
    const auto key = tips.empty() ? std::pair<int, LocalId>(-1, n)
                                  : std::pair<int, LocalId>(tips.front().zone, -1);
    members[key].push_back(n);
  }
  std::vector<LocalId> place(std::size_t(count_), -1);
  for (const auto& [key, nodes] : members) {
    std::vector<LocalId> free;
    std::vector<std::size_t> rows;
    for (const LocalId n : nodes) {
      for (const LocalId u : unknowns.of_cell(n)) {
        const std::ptrdiff_t row = rows_.find(u);
        if (held[std::size_t(u)] || row < 0) continue;
        place[std::size_t(u)] = LocalId(free.size());
        free.push_back(u);
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
    for (const LocalId u : free) place[std::size_t(u)] = -1;
    if (!free.empty())
      groups_.emplace_back(nodes.front(), std::move(free), std::move(rows), matrix);
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
  // every own unknown belongs to a run or has a row
  std::fill(forces.begin() + owned_, forces.end(), 0.0);
  regular_.apply(x, forces);
  for (std::size_t r = 0; r < rows_.unknown.size(); ++r) {
    forces[std::size_t(rows_.unknown[r])] = rows_.times(r, x, owned_);
  }
  halo_.add_forces(forces);
}

void CellStiffness::set_residual(std::span<const double> forces, std::span<const double> x,
                                 std::span<double> residual) const {
  std::fill(residual.begin() + owned_, residual.end(), 0.0);
  regular_.set_residual(forces, x, residual);
  for (std::size_t r = 0; r < rows_.unknown.size(); ++r) {
    const auto u = std::size_t(rows_.unknown[r]);
    residual[u] = (rows_.unknown[r] < owned_ ? forces[u] : 0.0) - rows_.times(r, x, owned_);
  }
  halo_.add_forces(residual);
  clear_held(residual);
}

void CellStiffness::subtract_held(std::span<const double> displacements,
                                  std::span<double> forces) const {
  for (const LocalId u : held_) {
    const double displacement = displacements[std::size_t(u)];
    if (displacement == 0.0) continue;
    // held cells have rows of their own; K is symmetric: its row is its column
    const auto row = std::size_t(rows_.find(u));
    for (std::size_t k = rows_.start[row]; k < rows_.start[row + 1]; ++k)
      forces[std::size_t(rows_.column[k])] -= rows_.value[k] * displacement;
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
