// SPDX-License-Identifier: BSD-3-Clause
/// Iterations of the multilevel solver on several ranks: at most a tenth more than on one, however
/// the cells are shared out. Run on 1-4 ranks by the suite; docs/solver.md has 5-8.
#include "tests/cracked_plates.hpp"

#include <gtest/gtest.h>

#include <iostream>

namespace cdca::testing {
namespace {

Equilibrium equilibrium_of(Model& model, const CrackRegistry& registry) {
  model.build_stiffness();
  model.lay_cracks(registry);
  return find_equilibrium(model, *make_solver(model), 1.0);
}

CrackRegistry registry_of(const CaseSpec& spec) {
  CrackRegistry registry;
  for (const CrackSpec& crack : spec.cracks) registry.add(crack.name, crack.points);
  const double side = std::min(spec.domain.size.x() / spec.domain.cells[0],
                               spec.domain.size.y() / spec.domain.cells[1]);
  registry.resolve_initial_meetings({spec.domain.origin, spec.domain.origin + spec.domain.size},
                                    1e-3 * side);
  return registry;
}

/// Squares of `block` nodes, dealt out in turn: all borders cut cracks and windows.
BlockPartition dealt_out(const CaseSpec& spec, int block) {
  const StructuredGrid grid(spec.domain.origin, spec.domain.size, spec.domain.cells[0],
                            spec.domain.cells[1]);
  std::vector<int> owner;
  for (int j = 0; j <= grid.ny() / block; ++j) {
    for (int i = 0; i <= grid.nx() / block; ++i)
      owner.push_back((i + 3 * j + i * j) % world().size());
  }
  return {grid, block, owner};
}

void expect_same_iterations(const char* name, CaseSpec spec) {
  spec.solver.coarsest_nodes = 60;
  const CrackRegistry registry = registry_of(spec);
  spec.cracks.clear();
  SerialCommunicator serial;
  Model alone(spec, serial, BlockPartition());
  const Equilibrium one = equilibrium_of(alone, registry);
  Model parts(spec, world(), world_partitioner());
  Model pieces(spec, world(), dealt_out(spec, 5));
  for (Model* model : {&parts, &pieces}) {
    const Equilibrium many = equilibrium_of(*model, registry);
    if (world().is_root())
      std::cout << "iterations, " << name << ", " << world().size()
                << " ranks: " << many.solver.iterations << ", alone " << one.solver.iterations
                << std::endl;
    EXPECT_LE(many.solver.iterations, 1.1 * one.solver.iterations + 0.5) << name;
    EXPECT_NEAR(many.strain_energy, one.strain_energy, 1e-7 * one.strain_energy) << name;
  }
}

TEST(MultilevelIterationsParallel, ManyCracks) {
  expect_same_iterations("20 cracks",
                         plate_of(47, 91, cracks_apart(20, 0.05, 3), Pull::by_traction));
}
TEST(MultilevelIterationsParallel, Crossing) {
  expect_same_iterations("crossing", plate_of(41, 83, crossing(), Pull::by_traction));
}
TEST(MultilevelIterationsParallel, NearlySevering) {
  expect_same_iterations("nearly severing", plate_of(41, 83, nearly_severing()));
}
TEST(MultilevelIterationsParallel, NetworkWithFragments) {
  expect_same_iterations("network", plate_of(30, 61, network(20, 0.5, 21), Pull::by_traction));
}
TEST(MultilevelIterationsParallel, WideTipZones) {
  CaseSpec spec = plate_of(41, 83, one_crack(), Pull::by_traction);
  spec.tip_radius = 5.5 / 41;
  expect_same_iterations("wide zones", spec);
}

}  // namespace
}  // namespace cdca::testing
