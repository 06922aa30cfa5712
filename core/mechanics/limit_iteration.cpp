// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/limit_iteration.hpp"

#include <Eigen/QR>

#include <algorithm>

namespace cdca {

std::vector<double> LimitIteration::next(const std::vector<double>& limits,
                                         const std::vector<double>& found) {
  tried_.push_back(limits);
  found_.push_back(found);
  if (tried_.size() > depth) {
    tried_.erase(tried_.begin());
    found_.erase(found_.begin());
  }
  const auto size = Eigen::Index(limits.size()), pairs = Eigen::Index(tried_.size()) - 1;
  Eigen::VectorXd next(size), residual(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const auto at = std::size_t(k);
    residual(k) = found[at] - limits[at];
    next(k) = found[at];
  }
  if (pairs > 0) {
    Eigen::MatrixXd residuals(size, pairs), steps(size, pairs);
    for (Eigen::Index p = 0; p < pairs; ++p) {
      const auto& x = tried_[std::size_t(p)];
      const auto& g = found_[std::size_t(p)];
      for (Eigen::Index k = 0; k < size; ++k) {
        const auto at = std::size_t(k);
        residuals(k, p) = residual(k) - (g[at] - x[at]);
        steps(k, p) = limits[at] - x[at] + residuals(k, p);
      }
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(residuals);
    fit.setThreshold(1e-8);
    next -= steps * fit.solve(residual);
  }
  std::vector<double> limits_next;
  for (Eigen::Index k = 0; k < size; ++k) limits_next.push_back(std::max(0.0, next(k)));
  return limits_next;
}

}  // namespace cdca
