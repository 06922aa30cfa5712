// SPDX-License-Identifier: BSD-3-Clause
/// The answer must not depend on the number of ranks, nor on which cells they own.
#include "core/mechanics/interaction_integral.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

namespace cdca::testing {
namespace {

constexpr int nx = 17, ny = 23;

/// Tips, a kink inside an element, a T, a Y and an X; face pressure, traction and body force.
CaseSpec crowded_plate(double tip_radius, SolverMethod method = SolverMethod::multilevel) {
  CaseSpec spec = plate({0, 0}, {1.7, 2.3}, nx, ny);
  spec.tip_radius = tip_radius;
  spec.solver.tolerance = 1e-11;
  spec.solver.method = method;
  spec.solver.coarsest_nodes = 30;                                         // three scales
  add_crack(spec, {{0, 0.43}, {0.41, 0.47}, {0.44, 0.53}, {0.82, 0.52}});  // edge crack with kinks
  add_crack(spec, {{0.3, 1.2}, {1.3, 1.31}});
  add_crack(spec, {{0.8, 1.9}, {0.8, 1.255}});  // T on the second
  add_crack(spec, {{1.25, 0.7}, {1.55, 0.6}});  // Y of three arms
  add_crack(spec, {{1.25, 0.7}, {1.05, 0.35}});
  add_crack(spec, {{1.25, 0.7}, {1.3, 1.02}});
  add_crack(spec, {{1.15, 1.9}, {1.55, 2.05}});  // X
  add_crack(spec, {{1.3, 2.15}, {1.38, 1.75}});
  add_crack(spec, {{0.1, 2.0}, {0.5, 2.0}});  // along a grid line, tips at nodes
  BoundarySpec bottom = on_side(Side::bottom), top = on_side(Side::top), faces;
  bottom.displacement = constant_load(0, 0);
  top.traction = constant_load(2, 5);
  faces.kind = BoundaryKind::crack;
  faces.crack = "crack2";
  faces.pressure = proportional_load(1.5);
  spec.boundaries = {bottom, top, faces};
  spec.domain.body_force = constant_load(0.3, -1);
  return spec;
}

struct Answer {
  std::vector<StressIntensity> tips;
  double energy = 0.0;
  std::vector<Vec2> reactions;
  std::vector<double> nodes;  ///< displacement of piece 0 of every node of the grid
  std::int64_t unknowns = 0;
};

Answer answer_of(Model& model) {
  model.build_stiffness();
  const Equilibrium e = find_equilibrium(model, *make_solver(model), 1.0);
  Answer a;
  a.tips = model.stress_intensities(1.0);
  a.energy = e.strain_energy;
  a.reactions = e.reactions;
  a.nodes.assign(std::size_t(2 * model.grid().node_count()), 0.0);
  for (LocalId n = 0; n < model.mesh().owned_nodes(); ++n) {
    const auto to = 2 * std::size_t(model.mesh().node_id(n)), from = 2 * std::size_t(n);
    a.nodes[to] = model.state()[from];
    a.nodes[to + 1] = model.state()[from + 1];
  }
  model.communicator().sum(std::span<double>(a.nodes));
  a.unknowns = model.communicator().sum(std::int64_t(model.unknowns().owned()));
  return a;
}

Answer on_one_rank(const CaseSpec& spec) {
  SerialCommunicator alone;
  Model model(spec, alone, BlockPartition());
  return answer_of(model);
}

void expect_same(const Answer& one, const Answer& many) {
  EXPECT_EQ(one.unknowns, many.unknowns);
  ASSERT_EQ(one.tips.size(), many.tips.size());
  double largest = 0.0, farthest = 0.0;
  for (const StressIntensity& k : one.tips)
    largest = std::max({largest, std::abs(k.k1), std::abs(k.k2)});
  for (std::size_t t = 0; t < one.tips.size(); ++t) {
    EXPECT_NEAR(one.tips[t].k1, many.tips[t].k1, 1e-6 * largest);
    EXPECT_NEAR(one.tips[t].k2, many.tips[t].k2, 1e-6 * largest);
  }
  EXPECT_NEAR(one.energy, many.energy, 1e-8 * std::abs(one.energy));
  for (std::size_t b = 0; b < one.reactions.size(); ++b) {
    EXPECT_LT((one.reactions[b] - many.reactions[b]).norm(), 1e-7 * one.reactions.front().norm());
  }
  for (const double u : one.nodes) farthest = std::max(farthest, std::abs(u));
  for (std::size_t k = 0; k < one.nodes.size(); ++k) {
    ASSERT_NEAR(one.nodes[k], many.nodes[k], 1e-7 * farthest) << "node " << k / 2;
  }
}

/// Owners by single cells: every border goes through tips, kinks, T, Y and X somewhere.
BlockPartition scattered(const StructuredGrid& grid, int ranks, int shift) {
  std::vector<int> owner;
  for (int j = 0; j <= grid.ny(); ++j) {
    for (int i = 0; i <= grid.nx(); ++i)
      owner.push_back(((i + shift) / 3 + 2 * ((j + shift) / 4)) % ranks);
  }
  return {grid, 1, owner};
}

TEST(RanksParallel, MetisPartition) {
  for (const SolverMethod method : {SolverMethod::krylov, SolverMethod::multilevel}) {
    for (const double tip_radius : {0.0, 0.25}) {
      if (method == SolverMethod::krylov && tip_radius > 0.0) continue;  // slow, and nothing new
      const CaseSpec spec = crowded_plate(tip_radius, method);
      Model model(spec, world(), world_partitioner());
      expect_same(on_one_rank(spec), answer_of(model));
    }
  }
}

TEST(RanksParallel, BordersThroughEveryKindOfCell) {
  for (const SolverMethod method : {SolverMethod::krylov, SolverMethod::multilevel}) {
    const CaseSpec spec = crowded_plate(0.0, method);
    const StructuredGrid grid(spec.domain.origin, spec.domain.size, nx, ny);
    const Answer one = on_one_rank(spec);
    for (int shift = 0; shift < 4; ++shift) {
      Model model(spec, world(), scattered(grid, world().size(), shift));
      expect_same(one, answer_of(model));
    }
  }
}

TEST(RanksParallel, WideTipZoneAcrossRanks) {
  const CaseSpec spec = crowded_plate(0.35);
  const StructuredGrid grid(spec.domain.origin, spec.domain.size, nx, ny);
  Model model(spec, world(), scattered(grid, world().size(), 1));
  expect_same(on_one_rank(spec), answer_of(model));
}

/// Forces of all cells in a state whose unknowns differ within each cell; squared and added up.
double square_of_forces(Model& model) {
  model.build_stiffness();
  const CellStiffness& cells = model.stiffness();
  std::vector<double> state(std::size_t(cells.count()), 0.0), forces = state;
  for (LocalId n = 0; n < model.mesh().node_count(); ++n) {
    double value = 0.0;
    for (const LocalId u : model.unknowns().of_cell(n)) state[std::size_t(u)] = 1 + value++ / 16;
  }
  cells.apply(state, forces);
  return cells.dot(forces, forces);
}

/// The tip of the first crack ends in a small triangle of three others: combinations of its
/// functions in the four cells round it, together, strain nothing.
TEST(RanksParallel, ATipShutInOneElementOfSeveralRanks) {
  CaseSpec spec = plate({0, 0}, {10, 10}, 10, 10);
  spec.solver.tolerance = 1e-11;
  add_crack(spec, {{2.02424, 1.42979}, {4.40033, 4.6781}});
  add_crack(spec, {{3.03817, 2.6076}, {7.6796, 9.6701}});
  add_crack(spec, {{1.82011, 2.5341}, {8.61342, 7.5396}});
  add_crack(spec, {{9.7173, 2.4034}, {3.97404, 5.1574}});
  add_crack(spec, {{6.60187, 1.73532}, {2.19495, 8.6812}});
  for (CrackSpec& crack : spec.cracks)
    crack.contact = {ContactLaw::frictionless, 1e6, 0, 0, 0, 0, 0};
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom), pin = at_point({0, 0});
  top.displacement[1] = constant_load(0, -1e-2)[1];
  bottom.displacement[1] = pin.displacement[0] = constant_load(0, 0)[1];
  spec.boundaries = {top, bottom, pin};
  const StructuredGrid grid(spec.domain.origin, spec.domain.size, 10, 10);
  std::vector<int> columns;
  for (GlobalId n = 0; n < grid.node_count(); ++n)
    columns.push_back(grid.node_index(n).i % world().size());
  SerialCommunicator alone;
  Model one(spec, alone, BlockPartition()), many(spec, world(), BlockPartition(grid, 1, columns));
  const double square = square_of_forces(one);
  EXPECT_NEAR(square_of_forces(many), square, 1e-9 * square);
  expect_same(on_one_rank(spec), answer_of(many));
}

TEST(RanksParallel, RankWithoutCells) {
  const CaseSpec spec = crowded_plate(0.0);
  const StructuredGrid grid(spec.domain.origin, spec.domain.size, nx, ny);
  const int busy = std::max(1, world().size() - 1);
  Model model(spec, world(), scattered(grid, busy, 0));
  expect_same(on_one_rank(spec), answer_of(model));
}

TEST(RanksParallel, MoreRanksThanCells) {
  CaseSpec spec = plate({0, 0}, {1, 1}, 1, 1);
  hold_rim(spec, [](const Vec2& x) { return Vec2(0.1 * x.y(), 0.2 * x.x()); });
  spec.boundaries.pop_back();
  Model model(spec, world(), world_partitioner());
  expect_same(on_one_rank(spec), answer_of(model));
}

}  // namespace
}  // namespace cdca::testing
