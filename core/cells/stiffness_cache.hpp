// SPDX-License-Identifier: BSD-3-Clause
/// Part matrices kept from one growth cycle to the next.
#pragma once

#include "core/cells/part_stiffness.hpp"

#include <unordered_map>
#include <vector>

namespace cdca {

/// Matrices of elements near cracks, found again as long as the cracks in the element and the
/// near-tip functions on it are bit for bit the same. What an increment touches differs, and only
/// that is integrated anew.
class StiffnessCache {
 public:
  /// Starts a new cycle: what is not asked for until the next one is forgotten.
  void begin_cycle();
  PartStiffness of(const BasisContext& context, GridIndex element, int part,
                   const ElasticMatrix& elastic);

  /// Parts integrated and parts found again since begin_cycle().
  std::int64_t integrated() const { return integrated_; }
  std::int64_t reused() const { return reused_; }

 private:
  using Store = std::unordered_map<std::uint64_t, Eigen::MatrixXd>;
  Store now_;
  Store before_;
  std::int64_t integrated_ = 0;
  std::int64_t reused_ = 0;
};

}  // namespace cdca
