// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/coarsest_solve.hpp"

#include "core/base/errors.hpp"

#include <Eigen/OrderingMethods>

#include <algorithm>

namespace cdca {

namespace {

struct Entry {
  std::int32_t row;
  std::int32_t column;
  double value;
};

/// The entries of all ranks, on every rank, in order of rank.
std::vector<Entry> entries_of_all(Communicator& communicator, std::vector<Entry> mine) {
  if (communicator.size() == 1) return mine;
  Bytes bytes, all;
  pack(bytes, std::span<const Entry>(mine));
  for (const Bytes& part : communicator.gather(bytes))
    all.insert(all.end(), part.begin(), part.end());
  communicator.broadcast(all);
  return unpack<Entry>(all);
}

constexpr double outgrown = 1.2;  ///< a factor so many times larger is worth a new order

void update(EliminationOrder& order, Eigen::Index size, const std::vector<Entry>& entries) {
  if (order.place.size() == size && double(order.entries_now) <= outgrown * double(order.entries))
    return;
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.size());
  for (const Entry& e : entries) triplets.emplace_back(e.row, e.column, 1.0);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  Permutation eliminated;
  Eigen::AMDOrdering<int>()(matrix.selfadjointView<Eigen::Lower>(), eliminated);
  order.place = Permutation(eliminated.inverse()).indices();
  order.entries = 0;
}

}  // namespace

CoarsestSolve::CoarsestSolve(const CellStiffness& cells, EliminationOrder& order) : cells_(cells) {
  Communicator& communicator = cells.communicator();
  const auto own = std::size_t(cells.owned());
  std::vector<double> counts(std::size_t(communicator.size()), 0.0);
  counts[std::size_t(communicator.rank())] = double(own);
  communicator.sum(std::span<double>(counts));
  for (std::size_t r = 0; r < counts.size(); ++r) {
    if (r < std::size_t(communicator.rank())) first_ += std::size_t(counts[r]);
    total_ += std::size_t(counts[r]);
  }
  // numbers over all ranks; -1: held
  std::vector<double> number(std::size_t(cells.count()), -1.0);
  for (std::size_t u = 0; u < own; ++u) number[u] = double(first_ + u);
  for (const LocalId u : cells.held()) number[std::size_t(u)] = -1.0;
  cells.halo().copy_state(number);

  std::vector<Entry> entries;
  for (const LocalId u : cells.held()) {
    const auto place = std::int32_t(first_ + std::size_t(u));
    entries.push_back({place, place, 1.0});
  }
  const StiffnessRows& rows = cells.rows();
  for (std::size_t r = 0; r < rows.unknown.size(); ++r) {
    const auto u = std::size_t(rows.unknown[r]);
    if (u >= own || number[u] < 0) continue;
    for (std::size_t k = rows.start[r]; k < rows.start[r + 1]; ++k) {
      const double column = number[std::size_t(rows.column[k])];
      if (column >= 0 && column <= number[u])
        entries.push_back({std::int32_t(number[u]), std::int32_t(column), rows.value[k]});
    }
  }
  entries = entries_of_all(communicator, std::move(entries));
  const auto size = Eigen::Index(total_);
  update(order, size, entries);
  place_ = order.place;
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.size());
  for (const Entry& e : entries) {
    const auto [low, high] = std::minmax(place_[e.row], place_[e.column]);
    triplets.emplace_back(high, low, e.value);
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  factor_.compute(matrix);
  if (factor_.info() != Eigen::Success) {
    throw SolveError("the stiffness of the coarsest cells could not be factored");
  }
  order.entries_now = factor_.matrixL().nestedExpression().nonZeros();
  if (order.entries == 0) order.entries = order.entries_now;
}

void CoarsestSolve::solve(std::span<const double> forces, std::span<double> moves) const {
  const auto own = Eigen::Index(cells_.owned());
  Eigen::VectorXd all = Eigen::VectorXd::Zero(Eigen::Index(total_));
  all.segment(Eigen::Index(first_), own) = Eigen::Map<const Eigen::VectorXd>(forces.data(), own);
  for (const LocalId u : cells_.held()) all[Eigen::Index(first_) + u] = 0.0;
  cells_.communicator().sum(std::span<double>(all.data(), total_));
  Eigen::VectorXd placed(all.size());
  for (Eigen::Index u = 0; u < all.size(); ++u) placed[place_[u]] = all[u];
  placed = factor_.solve(placed).eval();
  for (Eigen::Index u = 0; u < own; ++u)
    moves[std::size_t(u)] = placed[place_[Eigen::Index(first_) + u]];
}

}  // namespace cdca
