// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/reference_faces.hpp"

#include "core/base/dense_product.hpp"

#include <utility>

namespace cdca {

bool ReferenceFaces::refer(const Eigen::MatrixXd& compliance, const Eigen::VectorXd& missing) {
  missing_.resize(0);
  at_.assign(std::size_t(missing.size()), -1);
  used_ = 0;
  softer_.clear(), others_.clear();
  for (Eigen::Index k = 0; k < missing.size(); ++k)
    (missing[k] > 0.0 ? softer_ : others_).push_back(k);
  roots_ = missing(softer_).cwiseSqrt();
  to_others_ = compliance(others_, softer_) * roots_.asDiagonal();
  Eigen::MatrixXd matrix =
      -(roots_.asDiagonal() * compliance(softer_, softer_) * roots_.asDiagonal());
  matrix.diagonal().array() += 1.0;
  if (!factor_.compute(std::move(matrix))) return false;
  missing_ = missing;
  return true;
}

Eigen::VectorXd ReferenceFaces::moved(Eigen::VectorXd gaps) const {
  Eigen::VectorXd scaled = roots_.cwiseProduct(gaps(softer_));
  factor_.solve(scaled);
  gaps(softer_) = scaled.cwiseQuotient(roots_);
  gaps(others_) += to_others_ * scaled;
  return gaps;
}

std::vector<Eigen::Index> ReferenceFaces::need(const Eigen::MatrixXd& compliance,
                                               const std::vector<Eigen::Index>& places) {
  constexpr Eigen::Index room = 64;
  std::vector<Eigen::Index> absent, found;
  for (const Eigen::Index k : places) {
    if (at_[std::size_t(k)] < 0) absent.push_back(k);
  }
  if (!absent.empty()) {
    const auto count = Eigen::Index(absent.size());
    if (columns_.rows() != compliance.rows() || columns_.cols() < used_ + count)
      columns_.conservativeResize(compliance.rows(), used_ + count + room);
    Eigen::MatrixXd scaled = roots_.asDiagonal() * compliance(softer_, absent);
    factor_.solve_columns(scaled);
    Eigen::MatrixXd at_others = compliance(others_, absent);
    add_product(1.0, to_others_, scaled, Transposed::neither, at_others);
    auto fresh = columns_.middleCols(used_, count);
    fresh(softer_, Eigen::all) = roots_.cwiseInverse().asDiagonal() * scaled;
    fresh(others_, Eigen::all) = at_others;
    for (const Eigen::Index k : absent) at_[std::size_t(k)] = used_++;
  }
  for (const Eigen::Index k : places) found.push_back(at_[std::size_t(k)]);
  return found;
}

}  // namespace cdca
