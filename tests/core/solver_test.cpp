// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/errors.hpp"
#include "core/simulation/equilibrium.hpp"
#include "core/simulation/model.hpp"
#include "core/solver/equilibrium_solver.hpp"
#include "tests/world.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cdca {
namespace {

using testing::world;
using Vector = std::vector<double>;

LoadVector load(double x, double y) { return {proportional_load(x), proportional_load(y)}; }

BoundarySpec on_side(Side side) {
  BoundarySpec b;
  b.kind = BoundaryKind::side;
  b.side = side;
  return b;
}

/// A plate held at its lower side and pulled at its upper one.
CaseSpec plate(int nx, int ny, std::vector<std::vector<Vec2>> cracks) {
  CaseSpec spec;
  spec.domain.size = {1.0, 0.8};
  spec.domain.cells = {nx, ny};
  spec.material.young = 5.0;
  spec.material.poisson = 0.3;
  for (auto& points : cracks) spec.cracks.push_back({"c", std::move(points), 1});
  BoundarySpec bottom = on_side(Side::bottom), top = on_side(Side::top);
  bottom.displacement = load(0, 0);
  top.traction = load(0.3, 1.0);
  spec.boundaries = {bottom, top};
  spec.solver.method = SolverMethod::krylov;  // cells ready for sweeps
  return spec;
}

/// A bent edge crack, crossed by another one: cells of all kinds.
CaseSpec cracked_plate() {
  return plate(11, 9, {{{0, 0.41}, {0.3, 0.43}, {0.63, 0.35}}, {{0.35, 0.2}, {0.52, 0.62}}});
}

/// Blocks of four by four cells like a chess board: corners of four ranks, and cells that own all
/// their neighbours.
BlockPartition chess_board(const CaseSpec& spec) {
  const int nx = spec.domain.cells[0], ny = spec.domain.cells[1];
  const StructuredGrid grid(spec.domain.origin, spec.domain.size, nx, ny);
  std::vector<int> owner;
  for (int j = 0; j <= ny / 4; ++j)
    for (int i = 0; i <= nx / 4; ++i) owner.push_back((2 * (j % 2) + i % 2) % world().size());
  return {grid, 4, owner};
}

struct Loaded {
  explicit Loaded(const CaseSpec& of) : spec(of), model(spec, world(), chess_board(spec)) {
    model.build_stiffness();
    forces.assign(std::size_t(cells().count()), 0.0);
    add_external_forces(model.basis(), model.loads(1.0), forces);
    cells().clear_held(forces);
    scale = std::sqrt(cells().dot(forces, forces));
  }
  const CellStiffness& cells() const { return model.stiffness(); }
  Vector zeros() const { return Vector(std::size_t(cells().count()), 0.0); }
  /// Free own unknowns are random, all others 0.
  Vector random(unsigned seed) const {
    std::mt19937 engine(seed + 97 * unsigned(world().rank()));
    std::uniform_real_distribution<double> any(-1, 1);
    Vector x = zeros();
    for (LocalId u = 0; u < cells().owned(); ++u) x[std::size_t(u)] = any(engine);
    cells().clear_held(x);
    return x;
  }
  Vector apply(const Vector& x) const {
    Vector y = zeros();
    cells().apply(x, y);
    return y;
  }
  /// 1/2 u.Ku - f.u
  double energy(const Vector& u) const {
    return 0.5 * cells().dot(u, apply(u)) - cells().dot(forces, u);
  }

  CaseSpec spec;
  Model model;
  Vector forces;
  double scale = 0.0;
};

double largest_difference(const Vector& a, const Vector& b, LocalId count) {
  double largest = 0.0;
  for (std::size_t k = 0; k < std::size_t(count); ++k)
    largest = std::max(largest, std::abs(a[k] - b[k]));
  return world().max(largest);
}

TEST(SolverParallel, StiffnessIsSymmetric) {
  const Loaded plate(cracked_plate());
  const Vector x = plate.random(1), y = plate.random(2);
  const double xy = plate.cells().dot(x, plate.apply(y)), yx = plate.cells().dot(y, plate.apply(x));
  EXPECT_NEAR(xy, yx, 1e-12 * plate.cells().dot(x, plate.apply(x)));
  EXPECT_GT(plate.cells().dot(x, plate.apply(x)), 0.0);
}

TEST(SolverParallel, DisplacementsOfGhostsAreNotRead) {
  const Loaded plate(cracked_plate());
  Vector x = plate.random(3);
  const Vector expected = plate.apply(x);
  for (std::size_t u = std::size_t(plate.cells().owned()); u < x.size(); ++u) x[u] = 1e9;
  EXPECT_EQ(plate.apply(x), expected);
}

TEST(SolverParallel, RigidMotionsCauseNoForces) {
  const Loaded plate(cracked_plate());
  const CellUnknowns& unknowns = plate.model.unknowns();
  for (const Eigen::Vector3d& motion : {Eigen::Vector3d(1, 0, 0), {0, 1, 0}, {0, 0, 1}}) {
    Vector u = plate.zeros();
    for (LocalId n = 0; n < plate.model.mesh().owned_nodes(); ++n) {
      const Vec2 x = plate.model.grid().node_position(plate.model.mesh().node(n));
      const Vec2 v = motion.head<2>() + motion[2] * turned_left(x);
      for (int p = 0; p < unknowns.pieces(n); ++p) {
        u[std::size_t(unknowns.of_piece(n, p))] = v.x();
        u[std::size_t(unknowns.of_piece(n, p)) + 1] = v.y();
      }
    }
    for (const double f : plate.apply(u)) EXPECT_NEAR(f, 0.0, 1e-12);
  }
}

/// The sweep forth and back that serves krylov as preconditioner.
Vector precondition(const Loaded& plate, const Vector& force) {
  Vector scratch = force, move = plate.zeros();
  plate.cells().sweep(SweepDirection::forward, 1.0, scratch, move);
  plate.cells().sweep(SweepDirection::backward, 1.0, scratch, move);
  return move;
}

TEST(SolverParallel, PreconditionerIsSymmetricAndPositive) {
  const Loaded plate(cracked_plate());
  for (unsigned seed = 1; seed < 4; ++seed) {
    const Vector x = plate.random(seed), y = plate.random(seed + 10);
    const Vector mx = precondition(plate, x), my = precondition(plate, y);
    const double xmx = plate.cells().dot(x, mx), ymy = plate.cells().dot(y, my);
    EXPECT_GT(xmx, 0.0);
    EXPECT_NEAR(plate.cells().dot(x, my), plate.cells().dot(y, mx), 1e-12 * std::sqrt(xmx * ymy));
  }
}

TEST(SolverParallel, EverySweepOfTheRuleLowersTheEnergy) {
  const Loaded plate(cracked_plate());
  for (const double omega : {0.6, 1.0, 1.5}) {
    const auto one_sweep = make_relaxation({1e-300, omega, 1});
    Vector u = plate.zeros();
    double energy = 0.0;
    for (int k = 0; k < 25; ++k) {
      one_sweep->solve(plate.cells(), plate.forces, u, plate.scale);
      const double next = plate.energy(u);
      EXPECT_LT(next, energy) << "omega " << omega << ", sweep " << k;
      energy = next;
    }
  }
}

TEST(SolverParallel, TheRuleKeepsTheOutOfBalanceForces) {
  const Loaded plate(cracked_plate());
  Vector u = plate.zeros(), residual = plate.forces;
  for (int k = 0; k < 3; ++k) {
    plate.cells().sweep(SweepDirection::forward, 1.2, residual, u);
    plate.cells().return_forces(residual);
    plate.cells().clear_held(residual);
  }
  Vector expected = plate.apply(u);
  for (std::size_t k = 0; k < expected.size(); ++k) expected[k] = plate.forces[k] - expected[k];
  plate.cells().clear_held(expected);
  EXPECT_LT(largest_difference(residual, expected, plate.cells().owned()), 1e-13);
}

TEST(SolverParallel, RelaxationAndKrylovFindTheSameEquilibrium) {
  Loaded one(cracked_plate()), other(cracked_plate());
  const auto krylov = find_equilibrium(one.model, *make_krylov({1e-11, 1.0, 0}), 1.0);
  const auto relaxation = find_equilibrium(other.model, *make_relaxation({1e-11, 1.5, 0}), 1.0);
  EXPECT_NEAR(relaxation.strain_energy, krylov.strain_energy, 1e-9 * krylov.strain_energy);
  double largest = 0.0;
  for (const double u : one.model.state()) largest = std::max(largest, std::abs(u));
  EXPECT_LT(largest_difference(one.model.state(), other.model.state(), one.cells().count()),
            1e-7 * world().max(largest));
  EXPECT_LT(krylov.solver.iterations, relaxation.solver.iterations / 5);
}

TEST(SolverParallel, SupportsCarryTheLoad) {
  Loaded plate(cracked_plate());
  const auto found = find_equilibrium(plate.model, *make_krylov({1e-10, 1.0, 0}), 2.0);
  EXPECT_NEAR(found.reactions[0].x(), -2 * 0.3, 1e-8);
  EXPECT_NEAR(found.reactions[0].y(), -2 * 1.0, 1e-8);
}

TEST(SolverParallel, OverRelaxationIsFaster) {
  const Loaded plate(cracked_plate());
  int sweeps[2];
  for (const int k : {0, 1}) {
    Vector u = plate.zeros();
    const auto solver = make_relaxation({1e-4, k == 0 ? 1.0 : 1.6, 0});
    const auto report = solver->solve(plate.cells(), plate.forces, u, plate.scale);
    EXPECT_TRUE(report.converged);
    sweeps[k] = report.iterations;
  }
  EXPECT_LT(2 * sweeps[1], sweeps[0]);
}

TEST(SolverParallel, TheReportedResidualIsTheTrueOne) {
  const Loaded plate(cracked_plate());
  for (const auto& solver : {make_krylov({1e-9, 1.0, 0}), make_relaxation({1e-3, 1.5, 0})}) {
    Vector u = plate.zeros();
    const auto report = solver->solve(plate.cells(), plate.forces, u, plate.scale);
    Vector residual = plate.apply(u);
    for (std::size_t k = 0; k < residual.size(); ++k) residual[k] = plate.forces[k] - residual[k];
    plate.cells().clear_held(residual);
    const double norm = std::sqrt(plate.cells().dot(residual, residual)) / plate.scale;
    EXPECT_TRUE(report.converged);
    EXPECT_NEAR(norm, report.residual, 1e-10);
    EXPECT_LE(norm, 1e-3);
  }
}

TEST(SolverParallel, SaysWhenItDidNotConverge) {
  Loaded plate(cracked_plate());
  for (const auto& solver : {make_krylov({1e-12, 1.0, 3}), make_relaxation({1e-12, 1.0, 3})}) {
    Vector u = plate.zeros();
    const auto report = solver->solve(plate.cells(), plate.forces, u, plate.scale);
    EXPECT_FALSE(report.converged);
    EXPECT_EQ(report.iterations, 3);
    EXPECT_GT(report.residual, 1e-12);
    EXPECT_THROW(find_equilibrium(plate.model, *solver, 1.0), SolveError);
  }
}

TEST(SolverParallel, StopsWhereRoundingDoes) {
  const Loaded plate(cracked_plate());
  const auto solver = make_krylov({1e-30, 1.0, 0});
  Vector u = plate.zeros();
  const auto report = solver->solve(plate.cells(), plate.forces, u, plate.scale);
  EXPECT_TRUE(report.converged && report.rounded);
  EXPECT_GT(report.residual, 1e-30);
  EXPECT_LT(report.residual, 1e-11);
  const auto again =
      make_krylov({1e-30, 1.0, 2})->solve(plate.cells(), plate.forces, u, plate.scale);
  EXPECT_FALSE(again.converged || again.rounded) << "stopped by the limit of iterations";
}

/// Cells whose forces cannot be told more exactly than to `noise`.
class NoisyCells final : public CellSystem {
 public:
  NoisyCells(const CellSystem& cells, double noise) : cells_(cells), noise_(noise) {}
  LocalId owned() const override { return cells_.owned(); }
  LocalId count() const override { return cells_.count(); }
  Communicator& communicator() const override { return cells_.communicator(); }
  void apply(std::span<const double> x, std::span<double> forces) const override {
    cells_.apply(x, forces);
  }
  void set_residual(std::span<const double> forces, std::span<const double> x,
                    std::span<double> residual) const override {
    cells_.set_residual(forces, x, residual);
    for (std::size_t k = 0; k < std::size_t(owned()); ++k)
      residual[k] += engine_() & 1U ? noise_ : -noise_;
    cells_.clear_held(residual);
  }
  void sweep(SweepDirection direction, double omega, std::span<double> forces,
             std::span<double> moves) const override {
    cells_.sweep(direction, omega, forces, moves);
  }
  void sweep_all(double omega, std::span<double> forces, std::span<double> moves) const override {
    cells_.sweep_all(omega, forces, moves);
  }
  void return_forces(std::span<double> forces) const override { cells_.return_forces(forces); }
  void clear_held(std::span<double> values) const override { cells_.clear_held(values); }

 private:
  const CellSystem& cells_;
  double noise_;
  mutable std::minstd_rand engine_;
};

/// Rounding may be more than an estimate of it says: then the residual no longer falls.
TEST(SolverParallel, StopsWhereNothingMakesItMoreExact) {
  const Loaded plate(cracked_plate());
  for (const double noise : {1e-12, 1e-3}) {
    const NoisyCells cells(plate.cells(), noise * plate.scale);
    Vector u = plate.zeros();
    const auto report = make_krylov({1e-12, 1.0, 0})->solve(cells, plate.forces, u, plate.scale);
    const bool small = noise < 1e-6;
    EXPECT_EQ(report.converged, small);
    EXPECT_EQ(report.rounded, small) << "a part of a thousand is no rounding";
    EXPECT_GT(report.residual, 1e-12);
    EXPECT_LT(report.residual, 100 * noise);
  }
}

TEST(SolverParallel, EndsWhereTheResidualHasFallenFarEnough) {
  const Loaded plate(cracked_plate());
  const auto solver = make_krylov({1e-9, 1.0, 0});
  Vector u = plate.zeros();
  const auto rough = solver->solve(plate.cells(), plate.forces, u, plate.scale, {1.0, 0.05});
  EXPECT_TRUE(rough.converged);
  EXPECT_LE(rough.residual, 0.05);
  EXPECT_GT(rough.residual, 1e-3);
  Vector residual(u.size(), 0.0);
  plate.cells().set_residual(plate.forces, u, residual);
  EXPECT_NEAR(std::sqrt(plate.cells().dot(residual, residual)) / plate.scale, rough.residual, 1e-9)
      << "the residual is the true one";
  const auto exact = solver->solve(plate.cells(), plate.forces, u, plate.scale, {0.1, 0.0});
  EXPECT_LE(exact.residual, 1e-10);
}

TEST(SolverParallel, StartsFromWhereItIs) {
  const Loaded plate(cracked_plate());
  const auto solver = make_krylov({1e-9, 1.0, 0});
  Vector u = plate.zeros();
  EXPECT_GT(solver->solve(plate.cells(), plate.forces, u, plate.scale).iterations, 5);
  EXPECT_EQ(solver->solve(plate.cells(), plate.forces, u, plate.scale).iterations, 0);
}

/// 2.4.3, steps 1-3, word by word with the whole matrix.
void rule_by_hand(const Loaded& plate, const Eigen::MatrixXd& k, const std::vector<char>& held,
                  bool forward, double omega, Eigen::VectorXd& force, Eigen::VectorXd& u) {
  const LocalId nodes = plate.model.mesh().owned_nodes();
  for (LocalId m = 0; m < nodes; ++m) {
    std::vector<Eigen::Index> cell;
    for (const LocalId unknown : plate.model.unknowns().of_cell(forward ? m : nodes - 1 - m))
      if (!held[std::size_t(unknown)]) cell.push_back(unknown);
    if (cell.empty()) continue;
    const Eigen::VectorXd move = omega * k(cell, cell).ldlt().solve(force(cell));
    u(cell) += move;
    force -= k(Eigen::all, cell) * move;
  }
}

TEST(SweepTest, IsTheRuleOfThePaper) {
  ASSERT_EQ(world().size(), 1) << "the whole matrix is on one rank only";
  // a crack from side to side: regular cells, cells with two pieces, held cells
  CaseSpec spec = plate(9, 8, {{{0, 0.51}, {0.5, 0.67}, {1, 0.58}}});
  BoundarySpec left = on_side(Side::left);
  left.displacement = load(0, 0);
  spec.boundaries.push_back(left);
  const Loaded plate(spec);
  EXPECT_GT(plate.cells().regular_cells(), 4);
  const auto n = Eigen::Index(plate.cells().count());
  Eigen::MatrixXd k(n, n);
  for (Eigen::Index c = 0; c < n; ++c) {
    Vector unit = plate.zeros();
    unit[std::size_t(c)] = 1.0;
    const Vector column = plate.apply(unit);
    k.col(c) = Eigen::Map<const Eigen::VectorXd>(column.data(), n);
  }
  EXPECT_LT((k - k.transpose()).norm(), 1e-12);
  const auto held = plate.model.supports().flags(plate.cells().count());
  for (const bool forward : {true, false}) {
    Vector force = plate.random(5), u = plate.random(6);
    Eigen::VectorXd force_by_hand = Eigen::Map<Eigen::VectorXd>(force.data(), n);
    Eigen::VectorXd u_by_hand = Eigen::Map<Eigen::VectorXd>(u.data(), n);
    rule_by_hand(plate, k, held, forward, 1.3, force_by_hand, u_by_hand);
    plate.cells().sweep(forward ? SweepDirection::forward : SweepDirection::backward, 1.3, force,
                        u);
    EXPECT_TRUE(Eigen::Map<Eigen::VectorXd>(force.data(), n).isApprox(force_by_hand, 1e-12));
    EXPECT_TRUE(Eigen::Map<Eigen::VectorXd>(u.data(), n).isApprox(u_by_hand, 1e-12));
  }
}

TEST(SolverParallel, CellHeldInsideTheBodyStaysThere) {
  CaseSpec spec = plate(8, 8, {});
  BoundarySpec inside;
  inside.kind = BoundaryKind::point;
  inside.at = {0.625, 0.5};
  inside.displacement = load(0.02, -0.01);
  spec.boundaries.push_back(inside);
  Loaded plate(spec);
  const auto found = find_equilibrium(plate.model, *make_krylov({1e-10, 1.0, 2000}), 1.0);
  const LocalId node = plate.model.mesh().find_node({5, 5});
  if (node >= 0) {  // here, or at a neighbour's
    const auto u = std::size_t(plate.model.unknowns().of_piece(node, 0));
    EXPECT_NEAR(plate.model.state()[u], 0.02, 1e-14);
    EXPECT_NEAR(plate.model.state()[u + 1], -0.01, 1e-14);
  }
  EXPECT_NEAR(found.reactions[0].x() + found.reactions[2].x(), -0.3, 1e-8);
  EXPECT_NEAR(found.reactions[0].y() + found.reactions[2].y(), -1.0, 1e-8);
}

}  // namespace
}  // namespace cdca
