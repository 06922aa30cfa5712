// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/last_scale.hpp"

#include <algorithm>

namespace cdca {

std::int64_t most_nodes_of_last_scale(const CaseSpec& spec) {
  constexpr double nodes_per_element_of_crack = 100;
  double length = 0.0;
  bool touching = false, cohesive = false;
  for (const CrackSpec& crack : spec.cracks) {
    if (crack.contact.law == ContactLaw::none) continue;
    touching = true;
    cohesive = cohesive || crack.contact.law == ContactLaw::cohesive;
    length += length_of(crack);
  }
  const SolverSpec& solver = spec.solver;
  if (!touching) return solver.coarsest_nodes;
  const double nx = spec.domain.cells[0], ny = spec.domain.cells[1];
  const double side = std::min(spec.domain.size.x() / nx, spec.domain.size.y() / ny);
  const bool many = nodes_per_element_of_crack * length / side >= (nx + 1) * (ny + 1);
  if (!many || cohesive) return solver.coarsest_touching;
  return std::max<std::int64_t>(solver.coarsest_touching, solver.condensed_nodes);
}

}  // namespace cdca
