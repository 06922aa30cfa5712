// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/coarsest_factor.hpp"

#include <algorithm>

namespace cdca {

namespace {

constexpr double outgrown = 1.2;  ///< a factor so many times larger is worth a new order

std::uint64_t place_of(const Eigen::Triplet<double>& e) {
  return (std::uint64_t(std::uint32_t(e.row())) << 32) | std::uint32_t(e.col());
}

}  // namespace

bool CoarsestFactor::compute(std::size_t size, const StiffnessEntries& entries) {
  if (!same_places(size, entries)) lay_places(size, entries);
  return factorize([&](std::size_t k) { return entries[k].value(); });
}

bool CoarsestFactor::compute_again(std::span<const double> values) {
  return factorize([&](std::size_t k) { return values[k]; });
}

template <class ValueOf>
bool CoarsestFactor::factorize(const ValueOf& value_of) {
  double* values = matrix_.valuePtr();
  std::fill(values, values + matrix_.nonZeros(), 0.0);
  for (std::size_t k = 0; k < at_.size(); ++k) values[at_[k]] += value_of(k);
  return factor_.factorize(matrix_);
}

void CoarsestFactor::solve(Eigen::VectorXd& values) const {
  Eigen::VectorXd placed(values.size());
  for (Eigen::Index u = 0; u < values.size(); ++u) placed[place_[u]] = values[u];
  factor_.solve(placed);
  for (Eigen::Index u = 0; u < values.size(); ++u) values[u] = placed[place_[u]];
}

Eigen::MatrixXd CoarsestFactor::compliance(std::size_t count,
                                           const StiffnessEntries& directions) const {
  StiffnessEntries placed;
  for (const auto& e : directions) placed.emplace_back(e.row(), place_[e.col()], e.value());
  Eigen::SparseMatrix<double> rows(Eigen::Index(count), place_.size());
  rows.setFromTriplets(placed.begin(), placed.end());
  return factor_.compliance(rows);
}

bool CoarsestFactor::same_places(std::size_t size, const StiffnessEntries& entries) const {
  return place_.size() == Eigen::Index(size) &&
         std::equal(entries.begin(), entries.end(), places_.begin(), places_.end(),
                    [](const auto& e, std::uint64_t place) { return place_of(e) == place; });
}

void CoarsestFactor::lay_places(std::size_t size, const StiffnessEntries& entries) {
  const auto order_anew = [&] {
    place_ = elimination_order(size, entries);
    lay_fronts(entries);
    entries_of_order_ = factor_.entries();
  };
  if (place_.size() != Eigen::Index(size)) {
    order_anew();
    return;
  }
  // as many unknowns as before need not be the same ones
  lay_fronts(entries);
  if (double(factor_.entries()) > outgrown * double(entries_of_order_)) order_anew();
}

void CoarsestFactor::lay_fronts(const StiffnessEntries& entries) {
  matrix_ = in_order(place_, entries, false);
  matrix_.makeCompressed();
  places_.clear();
  at_.clear();
  for (const auto& e : entries) {
    places_.push_back(place_of(e));
    const auto [column, row] = std::minmax(place_[e.row()], place_[e.col()]);
    const int* rows = matrix_.innerIndexPtr();
    const int first = matrix_.outerIndexPtr()[column], last = matrix_.outerIndexPtr()[column + 1];
    at_.push_back(std::size_t(std::lower_bound(rows + first, rows + last, row) - rows));
  }
  factor_.lay_fronts(matrix_);
}

}  // namespace cdca
