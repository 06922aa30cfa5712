// SPDX-License-Identifier: BSD-3-Clause
/// The condensed body with faces in states that they are known to have: others are few changes.
#pragma once

#include "core/base/dense_factor.hpp"

#include <Eigen/Core>

#include <vector>

namespace cdca {

/// With springs kR of the faces, C the compliance at their places (m^2/N) with springs k0 of closed
/// faces, w lengths, and r^2 = w (k0 - kR), the compliance is
///
///     C_R = (I - C r^2)^-1 C,
///
/// and r C_R = (I - r C r)^-1 r C where r > 0: one factor of the places that are softer. All here
/// is by place, on one rank.
class ReferenceFaces {
 public:
  bool exists() const { return missing_.size() > 0; }
  /// missing: w (k0 - kR), Pa, not below 0. Returns whether faces so hold the body. It is always
  /// made from C: where a body is loose in one reference, rounding spoils others made from it.
  bool refer(const Eigen::MatrixXd& compliance, const Eigen::VectorXd& missing);
  const Eigen::VectorXd& missing() const { return missing_; }
  /// (I - C w (k0 - kR))^-1 gaps.
  Eigen::VectorXd moved(Eigen::VectorXd gaps) const;
  /// Makes columns of C_R that are not there yet. Returns where in columns() each of them is.
  std::vector<Eigen::Index> need(const Eigen::MatrixXd& compliance,
                                 const std::vector<Eigen::Index>& places);
  const Eigen::MatrixXd& columns() const { return columns_; }

 private:
  Eigen::VectorXd missing_;
  std::vector<Eigen::Index> softer_, others_;  ///< places
  Eigen::VectorXd roots_;                      ///< r, of those that are softer
  DenseFactor factor_;                         ///< of I - r C r, of those that are softer
  Eigen::MatrixXd to_others_;                  ///< C r, from those that are softer to the others
  std::vector<Eigen::Index> at_;               ///< by place: its column; -1: there is none
  Eigen::MatrixXd columns_;                    ///< those in use come first
  Eigen::Index used_ = 0;
};

}  // namespace cdca
