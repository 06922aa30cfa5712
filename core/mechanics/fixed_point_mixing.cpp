// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/fixed_point_mixing.hpp"

#include <Eigen/QR>

namespace cdca {

std::vector<double> FixedPointMixing::next(const std::vector<double>& tried,
                                           const std::vector<double>& found) {
  tried_.push_back(tried);
  found_.push_back(found);
  if (tried_.size() > depth_) {
    tried_.erase(tried_.begin());
    found_.erase(found_.begin());
  }
  const auto size = Eigen::Index(tried.size()), pairs = Eigen::Index(tried_.size()) - 1;
  Eigen::VectorXd next(size), residual(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const auto at = std::size_t(k);
    residual(k) = found[at] - tried[at];
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
        steps(k, p) = tried[at] - x[at] + residuals(k, p);
      }
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(residuals);
    fit.setThreshold(1e-8);
    next -= steps * fit.solve(residual);
  }
  return {next.begin(), next.end()};
}

}  // namespace cdca
