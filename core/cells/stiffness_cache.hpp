// SPDX-License-Identifier: BSD-3-Clause
/// Part matrices kept from one growth cycle to the next.
#pragma once

#include "core/base/content_cache.hpp"
#include "core/cells/part_stiffness.hpp"

namespace cdca {

/// Adds all that a part of an element and the functions on it depend on: the cracks in the element
/// and its near-tip functions.
void add_part(const BasisContext& context, GridIndex element, int part, const PartBasis& basis,
              Signature& signature);

/// Matrices of elements near cracks, found again as long as the cracks in the element and the
/// near-tip functions on it are bit for bit the same.
class StiffnessCache {
 public:
  void begin_cycle() { matrices_.begin_cycle(); }
  /// The matrix stays where it is until the next cycle.
  struct Found {
    std::vector<LocalId> unknowns;
    const Eigen::MatrixXd* matrix;
  };
  Found of(const BasisContext& context, GridIndex element, int part, const ElasticMatrix& elastic);

 private:
  ContentCache<Eigen::MatrixXd> matrices_{cycles_of_a_step};
};

}  // namespace cdca
