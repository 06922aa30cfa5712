// SPDX-License-Identifier: BSD-3-Clause
/// Random networks of cracks grow to the end: whatever meets whatever, a run ends as completed or
/// separated, with finite numbers, and growth never gives energy back.
#include "core/base/errors.hpp"
#include "core/cells/element_stiffness.hpp"
#include "core/cracks/random_cracks.hpp"
#include "core/simulation/creep.hpp"
#include "core/simulation/energy_ledger.hpp"
#include "core/simulation/equilibrium.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/failing_solver.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cdca::testing {
namespace {

/// Is the body with these cracks held everywhere?
bool is_sound(const CaseSpec& spec) {
  try {
    const Model model(spec, world(), world_partitioner());
    return true;
  } catch (const InputError&) {
    return false;  // a part is cut off from the start, or a crack is too short for the grid
  }
}

/// Which way the top moves, and what faces do that touch.
enum class Loading { tension, tension_with_contact, compression };

/// On three scales nearly all cells of a dense network lie in windows; whatever takes hundreds of
/// turns where faces touch is for one scale, the body condensed to them.
enum class Scales { one, three, three_and_few_cracks };

using Network = std::tuple<unsigned, Loading, Scales>;  ///< seed

/// Stiff faces; every third seed without friction.
ContactSpec contact_of_seed(unsigned seed, double h) {
  const double stiffness = 1e3 * 1000 / h;
  if (seed % 3 == 0) return {ContactLaw::frictionless, stiffness, 0, 0, 0, 0, 0};
  return {ContactLaw::coulomb, stiffness, 0.1 * stiffness, 0.1 * (seed % 7), 0, 0, 0};
}

/// A plate with up to `count` cracks of 2 to 10 elements; those that would cut off a
/// part are left out.
CaseSpec random_network(unsigned seed, int cells, int count, Loading loading) {
  CaseSpec spec = plate({0, 0}, {1, 1}, cells, cells);
  spec.solver.tolerance = loading == Loading::tension ? 1e-11 : 1e-9;
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom), pin = at_point({0, 0});
  top.displacement[1] = proportional_load(loading == Loading::compression ? -1e-3 : 1e-3);
  bottom.displacement[1] = proportional_load(0);
  pin.displacement[0] = proportional_load(0);
  spec.boundaries = {top, bottom, pin};
  const double h = 1.0 / cells;
  CrackFieldSpec field{count, {2 * h, 10 * h}, {0, 180}, {Vec2(0, 0), Vec2(1, 1)}, seed};
  for (const auto& ends : random_cracks(field)) {
    add_crack(spec, {ends[0], ends[1]});
    if (loading != Loading::tension) spec.cracks.back().contact = contact_of_seed(seed, h);
    if (!is_sound(spec)) spec.cracks.pop_back();
  }
  spec.material.toughness = 0.1;
  spec.growth.criterion = Criterion::hoop;
  return spec;
}

/// Seeds differ in grid, number of cracks, step length and kind of loading.
CaseSpec network_of_seed(unsigned seed, Loading loading, Scales scales = Scales::one) {
  std::mt19937 engine(seed);
  // small grids where faces touch, since every cycle takes many solves
  const bool touching = loading != Loading::tension;
  const int cells = touching ? 20 + int(engine() % 11) : 30 + int(engine() % 21);
  const int count = 5 + int(engine() % (scales == Scales::three_and_few_cracks ? 8 : 56));
  CaseSpec spec = random_network(seed, cells, count, loading);
  spec.loading.critical = seed % 2 == 0;
  spec.loading.max_events = 400;
  spec.loading.min_factor = 1e-6;
  spec.growth.fixed_step = seed % 3 == 0;
  spec.growth.step_length = {1.5, spec.growth.fixed_step ? 1.5 : 4.0};
  if (scales != Scales::one) in_scales_of(spec, 300);
  spec.load_factors.clear();
  for (int k = 1; k <= 20; ++k) spec.load_factors.push_back(0.3 * k);
  return spec;
}

void expect_finite(const Summary& s) {
  for (const StepRecord& step : s.steps) {
    EXPECT_TRUE(std::isfinite(step.strain_energy) && std::isfinite(step.external_work));
  }
  for (const CrackRecord& crack : s.cracks) {
    for (const Vec2& x : crack.points) EXPECT_TRUE(x.allFinite());
  }
  for (const TipRecord& tip : s.tips) EXPECT_TRUE(std::isfinite(tip.k1) && std::isfinite(tip.k2));
}

void expect_to_end_well(const Network& network) {
  const auto [seed, loading, scales] = network;
  const CaseSpec spec = network_of_seed(seed, loading, scales);
  Summary s;
  ASSERT_NO_THROW(s = run_simulation(spec, "test", world(), world_partitioner(), {}));
  std::cout << spec.cracks.size() << " cracks, " << spec.domain.cells[0] << " x "
            << spec.domain.cells[1] << ": " << s.status << " after " << s.steps.size() << " steps, "
            << s.events.size() << " events, iterations " << s.performance.solver_iterations << ", "
            << s.performance.linear_solves << " linear solves, " << s.performance.wall_s << " s, "
            << s.message << "\n";
  EXPECT_TRUE(s.status == "completed" || s.status == "separated") << s.status;
  expect_finite(s);
  double before = 0.0, most = 0.0;
  for (const StepRecord& step : s.steps) {
    most = std::max(most, step.external_work);
    const double spent = step.dissipated - step.friction_work;  // external work less strain energy
    EXPECT_GE(spent, -1e-7 * most) << "step " << step.step;
    if (loading == Loading::tension) {
      EXPECT_GE(spent, before - 1e-9 * most)
          << "step " << step.step << ", lost " << (before - spent) / most;
    }
    before = spent;
  }
}

/// A loose body in this network moves against hardly any resistance; where weak springs alone stop
/// it, it creeps by a few per cent of its way per solve, and takes more than a hundred.
TEST(LooseBodies, ComeToRestWithoutCreeping) {
  Model model(network_of_seed(3, Loading::compression), world(), world_partitioner());
  model.build_stiffness();
  const Equilibrium found = find_equilibrium(model, *make_solver(model), 0.3);
  EXPECT_TRUE(model.has_weak_springs());
  std::cout << found.contact_iterations << " solves\n";
  EXPECT_LT(found.contact_iterations, 50);
}

/// Where a loose body has run so far that no solve is exact, faces begin again from where they
/// were.
TEST(LooseBodies, ComeBackWhereNoSolveIsExact) {
  const CaseSpec spec = network_of_seed(3, Loading::compression);
  for (const int at : {1, 3}) {
    const auto model = built(spec);
    const auto solver = make_solver(*model);
    const Equilibrium found = find_equilibrium(*model, Fails(*solver, at, 1), 0.3);
    EXPECT_TRUE(model->has_weak_springs());
    EXPECT_LE(found.contact_unbalanced, 10 * spec.solver.tolerance);
    EXPECT_LE(found.solver.residual, spec.solver.tolerance);
  }
}

/// Blocks that jam: Newton steps with the whole body turn their faces nearly one by one, and take
/// about a hundred; on the condensed body they cost little.
TEST(JammedBlocks, SettleInFewTurns) {
  Model model(network_of_seed(2, Loading::compression), world(), world_partitioner());
  model.build_stiffness();
  const Equilibrium found = find_equilibrium(model, *make_solver(model), 0.3);
  std::cout << found.contact_iterations << " turns, " << found.linear_solves << " solves\n";
  EXPECT_LT(found.contact_iterations, 15);
  EXPECT_LT(found.linear_solves, 15);
}

/// In these networks the near-tip functions of a tip with others beside it act on a small corner of
/// one element, where some combinations of those of its four cells strain nothing to within
/// rounding: conjugate gradients found a direction without stiffness, and gave up.
TEST(SlowSmallTipZones, HoldWhatStrainsNothing) {
  for (const auto& [seed, loading] :
       {std::pair{55U, Loading::tension_with_contact}, std::pair{35U, Loading::compression}}) {
    Model model(network_of_seed(seed, loading, Scales::three), world(), world_partitioner());
    model.build_stiffness();
    EXPECT_NO_THROW(find_equilibrium(model, *make_solver(model), 0.3)) << "seed " << seed;
  }
}

/// Forces of all faces of the model in a state, with the springs that they have now.
std::vector<double> forces_of_faces(const Model& model, const std::vector<double>& state) {
  const ElasticMatrix elastic = model.material().elastic_matrix();
  StiffnessCache cache;
  FinestElements elements(model.basis(), elastic, cache, &model.contact());
  std::vector<double> forces(state.size(), 0.0);
  for (const GlobalId id : elements.special()) {
    for (const PartStiffness* face : elements.faces(model.grid().element_index(id))) {
      Eigen::VectorXd u(Eigen::Index(face->unknowns.size()));
      for (Eigen::Index k = 0; k < u.size(); ++k)
        u[k] = state[std::size_t(face->unknowns[std::size_t(k)])];
      const Eigen::VectorXd f = face->matrix * u;
      for (Eigen::Index k = 0; k < u.size(); ++k)
        forces[std::size_t(face->unknowns[std::size_t(k)])] += f[k];
    }
  }
  return forces;
}

/// Near-tip functions that strain nothing are held whatever faces do: else the energy of an
/// equilibrium would change where faces turn afterwards.
TEST(TouchingFaces, ChangeNothingButTheirSprings) {
  Model model(network_of_seed(35, Loading::compression), world(), world_partitioner());
  model.build_stiffness();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<double> state(model.state().size());
  for (double& u : state) u = any(random);
  const auto forces_without_faces = [&](const ContactAnswer& answer) {
    for (ContactPatch& p : model.contact().patches()) p.now = answer;
    model.renew_stiffness();
    std::vector<double> forces(state.size(), 0.0);
    model.stiffness().apply(state, forces);
    model.stiffness().add_spring_forces(state, forces, -1.0);
    const std::vector<double> of_faces = forces_of_faces(model, state);
    for (std::size_t k = 0; k < forces.size(); ++k) forces[k] -= of_faces[k];
    return forces;
  };
  ContactAnswer sticking;
  sticking.normal_spring = sticking.tangential_spring = 1e3 * 1000 / model.grid().smallest_side();
  const auto open = forces_without_faces({}), closed = forces_without_faces(sticking);
  double largest = 0.0, off = 0.0;
  for (std::size_t k = 0; k < open.size(); ++k) {
    largest = std::max(largest, std::abs(open[k]));
    off = std::max(off, std::abs(open[k] - closed[k]));
  }
  EXPECT_LE(off, 1e-9 * largest);
}

class NetworkGrowth : public ::testing::TestWithParam<Network> {};
TEST_P(NetworkGrowth, EndsWell) { expect_to_end_well(GetParam()); }
using ::testing::Combine;
using ::testing::Range;
using ::testing::Values;
const auto one_scale = Values(Scales::one), three_scales = Values(Scales::three);
const auto touching = Values(Loading::tension_with_contact, Loading::compression);
INSTANTIATE_TEST_SUITE_P(Seeds, NetworkGrowth,
                         Combine(Values(1U), Values(Loading::tension), three_scales));
INSTANTIATE_TEST_SUITE_P(Touching, NetworkGrowth, Combine(Values(1U), touching, one_scale));

class SlowNetworkGrowth : public NetworkGrowth {};
TEST_P(SlowNetworkGrowth, EndsWell) { expect_to_end_well(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Tension, SlowNetworkGrowth,
                         Combine(Range(2U, 43U), Values(Loading::tension), three_scales));
INSTANTIATE_TEST_SUITE_P(Contact, SlowNetworkGrowth, Combine(Range(2U, 101U), touching, one_scale));
INSTANTIATE_TEST_SUITE_P(ContactOnScales, SlowNetworkGrowth,
                         Combine(Range(5U, 101U, 15U), touching,
                                 Values(Scales::three_and_few_cracks)));

/// However quietly the faces come to rest: what is taken for equilibrium is one of forces, too.
TEST(ContactOfNetworks, WhatIsTakenIsExact) {
  for (const unsigned seed : {3U, 96U}) {
    const CaseSpec spec = network_of_seed(seed, Loading::compression);
    const auto model = built(spec);
    const Equilibrium e = find_equilibrium(*model, *make_solver(*model), 0.2);
    EXPECT_LE(e.solver.residual, spec.solver.tolerance) << "seed " << seed;
  }
}

/// Interior points come near the balance of this one, where friction is 0.6, and no nearer.
TEST(ContactOfNetworks, TurnsEndWhatInteriorPointsLeave) {
  const CaseSpec spec = network_of_seed(76, Loading::tension_with_contact);
  const auto model = built(spec);
  const Equilibrium e = find_equilibrium(*model, *make_solver(*model), 1.0);
  EXPECT_LE(e.contact_unbalanced, 10 * spec.solver.tolerance);
  EXPECT_LE(e.solver.residual, spec.solver.tolerance);
}

/// Creeps from where faces still keep to what they did before the load.
Crept crept(Model& model, double factor) {
  const auto solver = make_solver(model);
  find_equilibrium(model, *solver, factor, FaceMotion::none);
  const std::vector<double> none(model.state().size(), 0.0);
  Forces given{none, none, none};
  model.supports().prescribe(model.spec().boundaries, factor, given.held);
  ContactSolves solves(model, *solver, factor, given);
  return creep_to_balance(model, solves, given, 10 * model.spec().solver.tolerance, 200);
}

/// Without friction there is one equilibrium, whatever the way there.
TEST(Creep, EndsWhereTurnsEnd) {
  const CaseSpec spec = network_of_seed(96, Loading::compression);
  const auto one = built(spec), other = built(spec);
  const Equilibrium turned = find_equilibrium(*one, *make_solver(*one), 0.2);
  const Crept way = crept(*other, 0.2);
  std::cout << way.turns << " turns\n";
  ASSERT_TRUE(way.found);
  EXPECT_LE(way.unbalanced, 10 * spec.solver.tolerance);
  const Equilibrium found = find_equilibrium(*other, *make_solver(*other), 0.2);
  EXPECT_NEAR(found.strain_energy, turned.strain_energy, 1e-8 * turned.strain_energy);
  EXPECT_LE(found.contact_iterations, 5);
}

/// With friction it ends at one of them, and the way there has rubbed.
TEST(Creep, Rubs) {
  for (const unsigned seed : {4U, 37U, 41U}) {
    const CaseSpec spec = network_of_seed(seed, Loading::compression);
    const auto model = built(spec);
    ASSERT_TRUE(crept(*model, 0.2).found) << "seed " << seed;
    const auto before = model->contact().patches();
    const Equilibrium found = find_equilibrium(*model, *make_solver(*model), 0.2);
    EXPECT_LE(found.contact_iterations, 3) << "seed " << seed;
    double largest = 0.0, change = 0.0;
    for (std::size_t p = 0; p < before.size(); ++p) {
      const ContactAnswer &was = before[p].now, &is = model->contact().patches()[p].now;
      largest = std::max({largest, std::abs(is.normal), std::abs(is.tangential)});
      change = std::max(
          {change, std::abs(is.normal - was.normal), std::abs(is.tangential - was.tangential)});
    }
    // drag may have taken a little; another equilibrium would be far away
    EXPECT_LE(change, 1e-3 * largest) << "seed " << seed;
    EXPECT_LE(found.contact_unbalanced, 10 * spec.solver.tolerance) << "seed " << seed;
    EXPECT_GT(model->accept_contact(Model::Since::other_cracks), 0.0) << "seed " << seed;
  }
}

/// Where a load has been tried and left again, bodies creep from where faces were before: there
/// they are in balance, and nothing rubs. The first solves fail, so that they creep.
TEST(Creep, BeginsWhereTheHistoryOfFacesEnds) {
  for (const unsigned seed : {11U, 43U}) {
    const CaseSpec spec = network_of_seed(seed, Loading::compression);
    const auto model = built(spec);
    const auto solver = make_solver(*model);
    find_equilibrium(*model, *solver, 0.2);
    model->accept_contact();
    const Model::ContactMemory memory = model->contact_memory();
    const std::vector<double> state = model->state();
    find_equilibrium(*model, *solver, 0.4);
    model->remember(memory);
    model->set_origin(state);
    model->renew_stiffness();
    const Equilibrium back = find_equilibrium(*model, Fails(*solver, 1, 2), 0.2);
    ASSERT_TRUE(back.before_creep.has_value()) << "seed " << seed;
    const double rubbed = model->accept_contact(Model::Since::other_cracks);
    EXPECT_LE(std::abs(rubbed), 1e-8 * back.strain_energy) << "seed " << seed;
  }
}

/// A load step that ends in creep: what is left of the work of the supports, once it has been
/// stored or rubbed away, has gone into drag, which gives nothing back. With the reactions of the
/// end for those of the whole way more would have rubbed than that.
TEST(Creep, LeavesNoMoreToFrictionThanLoadsHaveDone) {
  for (const unsigned seed : {11U, 43U}) {
    const CaseSpec spec = network_of_seed(seed, Loading::compression);
    const auto model = built(spec);
    const auto solver = make_solver(*model);
    EnergyLedger energy;
    energy.new_loads(*model, find_equilibrium(*model, *solver, 0.2));
    energy.add_friction(model->accept_contact());
    const Equilibrium crept = find_equilibrium(*model, Fails(*solver, 1, 2), 0.6);
    ASSERT_TRUE(crept.before_creep.has_value()) << "seed " << seed;
    energy.new_loads(*model, crept);
    energy.add_friction(model->accept_contact());
    std::cout << "seed " << seed << ": friction " << energy.friction() << " J, spent "
              << energy.dissipated() << " J of " << energy.external_work() << " J\n";
    EXPECT_GT(energy.friction(), 0.0);
    EXPECT_GE(energy.dissipated(), energy.friction() - 1e-7 * energy.external_work());
  }
}

}  // namespace
}  // namespace cdca::testing
