// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/coarsest_solve.hpp"

#include "core/base/errors.hpp"

#include <utility>

namespace cdca {

namespace {

/// What all ranks have, on every rank, in order of rank.
template <class Entry>
std::vector<Entry> of_all(Communicator& communicator, std::vector<Entry> mine) {
  if (communicator.size() == 1) return mine;
  Bytes bytes, all;
  pack(bytes, std::span<const Entry>(mine));
  for (const Bytes& part : communicator.gather(bytes))
    all.insert(all.end(), part.begin(), part.end());
  communicator.broadcast(all);
  return unpack<Entry>(all);
}

void require(bool factored) {
  if (!factored) throw SolveError("the stiffness of the coarsest cells could not be factored");
}

}  // namespace

CoarsestSolve::CoarsestSolve(const CellStiffness& cells, CoarsestFactor& factor)
    : cells_(cells), factor_(factor) {
  Communicator& communicator = cells.communicator();
  const auto own = std::size_t(cells.owned());
  std::vector<double> counts(std::size_t(communicator.size()), 0.0);
  counts[std::size_t(communicator.rank())] = double(own);
  communicator.sum(std::span<double>(counts));
  for (std::size_t r = 0; r < counts.size(); ++r) {
    if (r < std::size_t(communicator.rank())) first_ += std::size_t(counts[r]);
    total_ += std::size_t(counts[r]);
  }
  number_.assign(std::size_t(cells.count()), -1.0);
  for (std::size_t u = 0; u < own; ++u) number_[u] = double(first_ + u);
  for (const LocalId u : cells.held()) number_[std::size_t(u)] = -1.0;
  cells.halo().copy_state(number_);

  held_ = cells.held().size();
  StiffnessEntries entries;
  for (const LocalId u : cells.held()) {
    const auto place = int(first_ + std::size_t(u));
    entries.emplace_back(place, place, 1.0);
  }
  const StiffnessRows& rows = cells.rows();
  for (std::size_t r = 0; r < rows.unknown.size(); ++r) {
    const auto u = std::size_t(rows.unknown[r]);
    if (u >= own || number_[u] < 0) continue;
    for (std::size_t k = rows.start[r]; k < rows.start[r + 1]; ++k) {
      const double column = number_[std::size_t(rows.column[k])];
      if (column < 0 || column > number_[u]) continue;
      entries.emplace_back(int(number_[u]), int(column), rows.value[k]);
      entries_.push_back(k);
    }
  }
  require(factor.compute(total_, of_all(communicator, std::move(entries))));
}

void CoarsestSolve::factor_turned() const {
  if (!turned_) return;
  std::vector<double> values(held_, 1.0);
  values.reserve(held_ + entries_.size());
  for (const std::size_t k : entries_) values.push_back(cells_.rows().value[k]);
  require(factor_.compute_again(of_all(cells_.communicator(), std::move(values))));
  turned_ = false;
}

void CoarsestSolve::solve(std::span<const double> forces, std::span<double> moves) const {
  factor_turned();
  const auto own = Eigen::Index(cells_.owned());
  Eigen::VectorXd all = Eigen::VectorXd::Zero(Eigen::Index(total_));
  all.segment(Eigen::Index(first_), own) = Eigen::Map<const Eigen::VectorXd>(forces.data(), own);
  for (const LocalId u : cells_.held()) all[Eigen::Index(first_) + u] = 0.0;
  cells_.communicator().sum(std::span<double>(all.data(), total_));
  factor_.solve(all);
  for (Eigen::Index u = 0; u < own; ++u) moves[std::size_t(u)] = all[Eigen::Index(first_) + u];
}

Eigen::MatrixXd CoarsestSolve::compliance(std::size_t measures,
                                          const std::vector<Effect>& effects) const {
  factor_turned();
  StiffnessEntries entries;
  for (const Effect& e : effects) {
    const double number = number_[std::size_t(e.unknown)];
    if (number >= 0) entries.emplace_back(int(e.measure), int(number), e.value);
  }
  const StiffnessEntries all = of_all(cells_.communicator(), std::move(entries));
  return cells_.communicator().rank() == 0 ? factor_.compliance(measures, all) : Eigen::MatrixXd();
}

}  // namespace cdca
