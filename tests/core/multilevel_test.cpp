// SPDX-License-Identifier: BSD-3-Clause
/// The hierarchy of cells: pieces and stiffness on coarse scales, and the V-cycle, on any ranks.
#include "core/solver/multilevel.hpp"

#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace cdca::testing {
namespace {

using Vector = std::vector<double>;

/// Odd numbers of elements, an edge crack with a kink, a crossing, a T, tips everywhere.
CaseSpec cracked(double tip_radius = 0.0) {
  CaseSpec spec = plate({0, 0}, {1.9, 2.3}, 37, 45);
  spec.tip_radius = tip_radius;
  spec.solver.coarsest_nodes = 40;
  spec.solver.tolerance = 1e-10;
  add_crack(spec, {{0, 0.43}, {0.41, 0.47}, {0.44, 0.53}, {0.82, 0.52}});
  add_crack(spec, {{0.3, 1.2}, {1.6, 1.31}});
  add_crack(spec, {{0.8, 1.9}, {0.8, 1.245}});
  add_crack(spec, {{1.15, 1.7}, {1.65, 2.05}});
  add_crack(spec, {{1.25, 2.1}, {1.45, 1.6}});
  BoundarySpec bottom = on_side(Side::bottom), top = on_side(Side::top);
  bottom.displacement = constant_load(0, 0);
  top.traction = constant_load(2, 5);
  spec.boundaries = {bottom, top};
  return spec;
}

/// Blocks of three by three cells, owned in turn: borders cross cracks, tips and junctions.
BlockPartition patchwork(const CaseSpec& spec) {
  const StructuredGrid grid(spec.domain.origin, spec.domain.size, spec.domain.cells[0],
                            spec.domain.cells[1]);
  std::vector<int> owner;
  for (int j = 0; j <= grid.ny() / 3; ++j) {
    for (int i = 0; i <= grid.nx() / 3; ++i)
      owner.push_back((i / 2 + 3 * (j / 2)) % world().size());
  }
  return {grid, 3, owner};
}

struct Built {
  explicit Built(const CaseSpec& spec) : model(spec, world(), patchwork(spec)) {
    model.build_stiffness();
  }
  const CellSystem& cells(std::size_t scale) const {
    return model.hierarchy().scale(scale).cells();
  }
  Vector zeros(std::size_t scale) const { return Vector(std::size_t(cells(scale).count()), 0.0); }
  Vector random(std::size_t scale, unsigned seed) const {
    std::mt19937 engine(seed + 97 * unsigned(world().rank()));
    std::uniform_real_distribution<double> any(-1, 1);
    Vector x = zeros(scale);
    for (LocalId u = 0; u < cells(scale).owned(); ++u) x[std::size_t(u)] = any(engine);
    cells(scale).clear_held(x);
    return x;
  }
  Vector apply(std::size_t scale, const Vector& x) const {
    Vector y = zeros(scale);
    cells(scale).apply(x, y);
    cells(scale).clear_held(y);
    return y;
  }
  Model model;
};

TEST(MultilevelParallel, SeveralScales) {
  const Built plate(cracked());
  EXPECT_EQ(plate.model.hierarchy().count(), 5U);
}

/// Scales of a plate of 441 nodes with a crack so many elements long.
std::size_t scales_with_crack(double elements, ContactLaw law, int condensed_nodes = 500) {
  CaseSpec spec = plate({0, 0}, {1, 1}, 20, 20);
  spec.solver.coarsest_nodes = 60;
  spec.solver.coarsest_touching = 150;
  spec.solver.condensed_nodes = condensed_nodes;
  add_crack(spec, {{0.27, 0.52}, {0.27 + 0.05 * elements, 0.52}});
  spec.cracks.back().contact = {.law = law, .normal_stiffness = 1e4};
  BoundarySpec bottom = on_side(Side::bottom);
  bottom.displacement = constant_load(0, 0);
  spec.boundaries = {bottom};
  Model model(spec, world(), patchwork(spec));
  model.build_stiffness();
  EXPECT_EQ(model.condenses(), model.hierarchy().count() == 1);
  return model.hierarchy().count();
}

TEST(MultilevelParallel, LastScaleIsLargerTheMoreFacesTouch) {
  EXPECT_EQ(scales_with_crack(6.0, ContactLaw::none), 3U);
  EXPECT_EQ(scales_with_crack(4.0, ContactLaw::frictionless), 2U) << "fewer than nodes / 100";
  EXPECT_EQ(scales_with_crack(5.0, ContactLaw::frictionless), 1U);
  EXPECT_EQ(scales_with_crack(5.0, ContactLaw::frictionless, 400), 2U) << "too many nodes";
  EXPECT_EQ(scales_with_crack(5.0, ContactLaw::cohesive), 2U) << "these do not settle so";
}

TEST(MultilevelParallel, CoarseStiffnessIsThatOfTheInterpolatedMoves) {
  const Built plate(cracked());
  for (std::size_t k = 1; k < plate.model.hierarchy().count(); ++k) {
    Vector coarse = plate.random(k, 1), fine = plate.zeros(k - 1);
    const double expected = plate.cells(k).dot(coarse, plate.apply(k, coarse));
    plate.model.hierarchy().scale(k - 1).add_moves_of_coarser(coarse, fine);
    Vector held = fine;
    plate.cells(k - 1).clear_held(held);
    EXPECT_EQ(fine, held) << "coarse moves vanish at supports";
    const double found = plate.cells(k - 1).dot(fine, plate.apply(k - 1, fine));
    EXPECT_NEAR(found, expected, 1e-12 * expected) << "scale " << k;
  }
}

TEST(MultilevelParallel, TransfersAreTransposed) {
  const Built plate(cracked());
  for (std::size_t k = 1; k < plate.model.hierarchy().count(); ++k) {
    const Scale& scale = plate.model.hierarchy().scale(k - 1);
    Vector x = plate.random(k, 3), px = plate.zeros(k - 1), pty = plate.zeros(k);
    const Vector y = plate.random(k - 1, 4);
    scale.add_moves_of_coarser(x, px);
    scale.forces_to_coarser(y, pty);
    EXPECT_NEAR(plate.cells(k - 1).dot(px, y), plate.cells(k).dot(x, pty),
                1e-12 * double(y.size()));
  }
}

/// Two steps leave T_2 of the rate, scaled to 1 where nothing moves, of every rough move; with all
/// rates below the largest one they never move farther than 1 + 1 / T_2 times the way.
TEST(MultilevelParallel, PlainCellsMoveAlikeOnBothSidesAndNotTooFar) {
  constexpr double middle = 1.15 / 0.85;
  const double farthest = 1.0 + 1.0 / (2.0 * middle * middle - 1.0);
  const Built plate(cracked());
  for (std::size_t k = 0; k + 1 < plate.model.hierarchy().count(); ++k) {
    const Scale& scale = plate.model.hierarchy().scale(k);
    const CellSystem& cells = plate.cells(k);
    double most = 0.0;
    for (unsigned seed = 1; seed < 4; ++seed) {
      const Vector x = plate.apply(k, plate.random(k, seed)), y = plate.random(k, seed + 10);
      Vector mx = plate.random(k, 7), my = plate.zeros(k);
      scale.start_plain_cells(x, mx);
      scale.move_plain_cells(y, my);
      const double xmx = cells.dot(x, mx), ymy = cells.dot(y, my);
      EXPECT_GT(xmx, 0.0);
      EXPECT_GT(ymy, 0.0);
      EXPECT_NEAR(cells.dot(x, my), cells.dot(y, mx), 1e-12 * std::sqrt(xmx * ymy));
      // towards the move that goes farthest
      for (int step = 0; step < 30; ++step) {
        mx = my;
        scale.start_plain_cells(plate.apply(k, mx), my);
        const double now = cells.dot(my, plate.apply(k, mx)) / cells.dot(mx, plate.apply(k, mx));
        most = std::max(most, now);
      }
    }
    EXPECT_LE(most, farthest + 1e-9) << "scale " << k;
    EXPECT_GT(most, 0.9) << "scale " << k;
  }
}

TEST(MultilevelParallel, CycleIsSymmetricAndPositive) {
  for (const double tip_radius : {0.0, 0.2}) {
    const Built plate(cracked(tip_radius));
    VCycle cycle(plate.model.hierarchy());
    for (unsigned seed = 1; seed < 4; ++seed) {
      // forces of moves of size 1: near-tip functions of wide zones are almost dependent, and
      // forces at random would cause moves beyond all measure
      const Vector x = plate.apply(0, plate.random(0, seed));
      const Vector y = plate.apply(0, plate.random(0, seed + 10));
      Vector mx = plate.zeros(0), my = plate.zeros(0), scratch = plate.zeros(0);
      cycle(x, scratch, mx);
      cycle(y, scratch, my);
      const double xmx = plate.cells(0).dot(x, mx), ymy = plate.cells(0).dot(y, my);
      EXPECT_GT(xmx, 0.0);
      EXPECT_NEAR(plate.cells(0).dot(x, my), plate.cells(0).dot(y, mx),
                  1e-11 * std::sqrt(xmx * ymy));
    }
  }
}

TEST(MultilevelParallel, FindsTheFieldsOfKrylov) {
  CaseSpec spec = cracked();
  Built multilevel(spec);
  spec.solver.method = SolverMethod::krylov;
  Built krylov(spec);
  const auto many = find_equilibrium(multilevel.model, *make_solver(multilevel.model), 1.0);
  const auto one = find_equilibrium(krylov.model, *make_solver(krylov.model), 1.0);
  EXPECT_NEAR(many.strain_energy, one.strain_energy, 1e-9 * one.strain_energy);
  double largest = 0.0, farthest = 0.0;
  for (std::size_t u = 0; u < 2 * std::size_t(krylov.model.mesh().owned_nodes()); ++u) {
    largest = std::max(largest, std::abs(krylov.model.state()[u]));
    farthest = std::max(farthest, std::abs(krylov.model.state()[u] - multilevel.model.state()[u]));
  }
  EXPECT_LT(world().max(farthest), 1e-7 * world().max(largest));
}

TEST(MultilevelParallel, TakesTheSameStepsOnAnyRanks) {
  for (const double tip_radius : {0.0, 0.2}) {
    const CaseSpec spec = cracked(tip_radius);
    Built many(spec);
    SerialCommunicator alone;
    Model one(spec, alone, BlockPartition());
    one.build_stiffness();
    const int expected = find_equilibrium(one, *make_solver(one), 1.0).solver.iterations;
    const int found = find_equilibrium(many.model, *make_solver(many.model), 1.0).solver.iterations;
    EXPECT_LE(expected, 40);
    EXPECT_NEAR(found, expected, 1);
  }
}

/// Windows are exact and act in turn, so none is too large, nor is any overlap: docs/solver.md.
TEST(MultilevelParallel, WindowsOfAnyShape) {
  const Built plate(cracked());
  const Model& model = plate.model;
  const auto held = model.supports().flags(model.unknowns().count());
  const ElasticMatrix elastic = model.material().elastic_matrix();
  Vector forces = plate.zeros(0);
  add_external_forces(model.basis(), model.loads(1.0), forces);
  plate.cells(0).clear_held(forces);
  const double scale = std::sqrt(plate.cells(0).dot(forces, forces));
  const auto iterations = [&](const WindowShape& shape) {
    Hierarchy hierarchy({shape, 40});
    const auto own_rows = hierarchy.plan(model.basis());
    StiffnessCache cache;
    FinestElements elements(model.basis(), elastic, cache, nullptr);
    const CellStiffness cells(model.mesh(), model.unknowns(), elements, held, {}, own_rows,
                              Sweeps::none, world());
    hierarchy.build({model.basis(), elastic, held, {}, nullptr}, cells);
    Vector u = plate.zeros(0);
    return make_multilevel({1e-10, 1.0, 100}, hierarchy)->solve(cells, forces, u, scale).iterations;
  };
  const int usual = iterations(WindowShape());
  for (const WindowShape& shape : {WindowShape{1, 6, 6}, {8, 8, 8}, {64, 0, 2}}) {
    EXPECT_LE(iterations(shape), usual + 2) << shape.tile << " " << shape.overlap;
  }
}

TEST(MultilevelParallel, GrowthRebuildsOnlyTheWindowsThatItTouches) {
  Built plate(cracked());
  const std::int64_t all = world().sum(plate.model.hierarchy().factors().made());
  CrackRegistry registry = plate.model.registry();
  registry.advance(0, 1, {0.87, 0.525}, TipState::active, -1, {1, 0});
  plate.model.lay_cracks(registry);
  const std::int64_t made = world().sum(plate.model.hierarchy().factors().made());
  EXPECT_GT(made, 0);
  EXPECT_LT(made, all / 2);
}

}  // namespace
}  // namespace cdca::testing
