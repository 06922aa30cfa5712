// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/reference_faces.hpp"

#include "core/base/dense_factor.hpp"
#include "core/base/dense_product.hpp"

#include <utility>

namespace cdca {

bool ReferenceFaces::refer(const Eigen::MatrixXd& compliance, const Eigen::VectorXd& missing) {
  missing_.resize(0);
  at_.assign(std::size_t(missing.size()), -1);
  used_ = 0;
  std::vector<Eigen::Index> softer;
  for (Eigen::Index k = 0; k < missing.size(); ++k) {
    if (missing[k] > 0.0) softer.push_back(k);
  }
  // H = C r L^-T for r^2 = w (k0 - kR) and L L^T = I - r C r
  const Eigen::VectorXd roots = missing(softer).cwiseSqrt();
  half_ = compliance(Eigen::all, softer) * roots.asDiagonal();
  Eigen::MatrixXd matrix = -(roots.asDiagonal() * half_(softer, Eigen::all));
  matrix.diagonal().array() += 1.0;
  DenseFactor factor;
  if (!factor.compute(std::move(matrix))) return false;
  factor.solve_rows(half_);
  missing_ = missing;
  return true;
}

Eigen::VectorXd ReferenceFaces::moved(const Eigen::MatrixXd& compliance,
                                      const Eigen::VectorXd& gaps) const {
  const Eigen::VectorXd forces = missing_.cwiseProduct(gaps);
  return gaps + compliance * forces + half_ * (half_.transpose() * forces);
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
    auto fresh = columns_.middleCols(used_, count);
    fresh = compliance(Eigen::all, absent);
    const Eigen::MatrixXd rows = half_(absent, Eigen::all);
    add_product(1.0, half_, rows, Transposed::second, fresh);
    for (const Eigen::Index k : absent) at_[std::size_t(k)] = used_++;
  }
  for (const Eigen::Index k : places) found.push_back(at_[std::size_t(k)]);
  return found;
}

}  // namespace cdca
