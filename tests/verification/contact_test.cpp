// SPDX-License-Identifier: BSD-3-Clause
/// Faces that touch: patch tests (M3), the sliding block (M4), stick and slip (M5), closed inclined
/// cracks, and cohesive faces.
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"
#include "tests/verification/reference_solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace cdca::testing {
namespace {

constexpr double degree = std::numbers::pi / 180;

ContactSpec coulomb(double normal, double tangential, double friction, double cohesion = 0.0) {
  return {ContactLaw::coulomb, normal, tangential, friction, cohesion, 0.0, 0.0};
}

/// A crack through the unit plate under an angle, through (0.5, at).
std::vector<Vec2> cut(double degrees, double at) {
  const double slope = std::tan(degrees * degree);
  return {{0, at - 0.5 * slope}, {1, at + 0.5 * slope}};
}

/// The bottom rests on rollers, the top is pressed down by 1.
CaseSpec pressed(int n, const std::vector<std::vector<Vec2>>& cuts, const ContactSpec& contact) {
  CaseSpec spec = plate({0, 0}, {1, 1}, n, n);
  for (const auto& points : cuts) {
    add_crack(spec, points);
    spec.cracks.back().contact = contact;
  }
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom), pin = at_point({0, 0});
  top.traction = constant_load(0, -1);
  bottom.displacement[1] = proportional_load(0);
  pin.displacement[0] = proportional_load(0);
  spec.boundaries = {top, bottom, pin};
  return spec;
}

/// Where a crack passes a node so closely that a sliver joins the part across it, the springs stand
/// round the sliver: that is exact to a thousandth only.
bool has_slivers(const Model& model) {
  for (const GlobalId id : model.cuts().touched_elements()) {
    for (const auto& polygon : model.cuts().find(model.grid().element_index(id))->polygons) {
      if (polygon.continues) return true;
    }
  }
  return false;
}

void expect_uniform(const Solved& s, const Voigt& stress) {
  const double bar = has_slivers(*s.model) ? 1e-3 : 1e-8;
  for (int j = 0; j < 17; ++j) {
    for (int i = 0; i < 17; ++i) {
      const Vec2 x((i + 0.37) / 17, (j + 0.41) / 17);
      const Voigt computed = s.model->material().stress(s.model->field_at(x).gradient);
      EXPECT_LT((computed - stress).norm(), bar * stress.norm()) << x.transpose();
    }
  }
}

class ContactPatch : public ::testing::TestWithParam<double> {};

/// M3: the stress stays uniform, and the faces give way by s_n / k_N and t / k_T everywhere.
TEST_P(ContactPatch, UniformStressPassesThroughCuts) {
  const double angle = GetParam();
  const double normal = 4e4, tangential = 3e3;
  const std::vector<std::vector<std::vector<Vec2>>> layouts{
      {cut(angle, 0.52)}, {cut(angle, 0.34), cut(-0.5 * angle, 0.71)}};
  for (const auto& cuts : layouts) {
    const Solved s = solved(pressed(13, cuts, coulomb(normal, tangential, 0.6)));
    expect_uniform(s, {0, -1, 0});
    const bool slivers = has_slivers(*s.model);
    double worst = 0.0;
    for (const auto& p : s.model->contact().patches()) {
      const auto& points = cuts[std::size_t(p.crack)];
      const Vec2 t = (points[1] - points[0]).normalized();
      const double pressure = -t.x() * t.x(), shear = -t.x() * t.y();
      EXPECT_EQ(p.now.state, ContactState::stick);
      const ContactGroup& shown = s.model->contact().group_of(p);
      const double bar = slivers ? 1e-3 : 1e-8;
      worst =
          std::max({worst, std::abs(shown.normal - pressure), std::abs(shown.tangential - shear)});
      EXPECT_NEAR(shown.normal, pressure, bar);
      EXPECT_NEAR(shown.tangential, shear, bar);
      EXPECT_NEAR(shown.gap, pressure / normal, bar / normal);
      if (slivers) continue;  // single faces round them are off by more
      EXPECT_NEAR(p.gap.normal, pressure / normal, 1e-9 / normal);
      EXPECT_NEAR(p.gap.tangential, shear / tangential, 1e-9 / tangential);
    }
    std::cout << angle << " degrees, " << cuts.size() << " cuts" << (slivers ? ", slivers" : "")
              << ": tractions off by " << worst << "\n";
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, ContactPatch, ::testing::Values(0.0, 10.0, 22.0, 30.0));

/// Two blocks; the top of the upper one is down by `down`, and moved sideways by the load factor.
struct Blocks {
  static constexpr double normal = 5e4, tangential = 2e4, friction = 0.4, down = 1e-3;
  std::unique_ptr<Model> model;

  explicit Blocks(double at) {
    CaseSpec spec = plate({0, 0}, {1, 2}, 7, 14);
    add_crack(spec, {{0, at}, {1, at}});
    spec.cracks.back().contact = coulomb(normal, tangential, friction);
    BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom);
    top.displacement[0] = LoadValue{[](double, double, double s) { return s; }, true, "s"};
    top.displacement[1] = LoadValue{[](double, double, double) { return -down; }, false, "-d"};
    bottom.displacement = constant_load(0, 0);
    spec.boundaries = {top, bottom};
    model = built(spec);
  }
  /// Sideways force on the top over the force that presses.
  double force_at(double s) {
    const Equilibrium e = find_equilibrium(*model, *make_solver(*model), s);
    model->accept_contact();
    return e.reactions.at(0).x() / std::abs(e.reactions.at(0).y());
  }
};

/// Friction takes the mean of the tractions before and after where the loads have changed, and
/// those after where cracks have grown: from rest, twice as much; once it slides, the same.
TEST(FrictionWork, CountsTheTractionsOfItsPath) {
  using Since = Model::Since;
  Blocks by_loads(1.0), by_cracks(1.0);
  const auto slide = [](Blocks& blocks, double to, Since since) {
    find_equilibrium(*blocks.model, *make_solver(*blocks.model), to);
    return blocks.model->accept_contact(since);
  };
  slide(by_loads, 0.0, Since::other_loads);
  slide(by_cracks, 0.0, Since::other_loads);
  const double mean = slide(by_loads, 0.01, Since::other_loads);
  EXPECT_GT(mean, 0.0);
  EXPECT_NEAR(slide(by_cracks, 0.01, Since::other_cracks), 2 * mean, 1e-6 * mean);
  const double further = slide(by_loads, 0.02, Since::other_loads);
  EXPECT_NEAR(slide(by_cracks, 0.02, Since::other_cracks), further, 1e-6 * further);
}

/// Flaws with cohesion stick at first, and slide long before one of them grows. What that takes is
/// the same as on a way of many given steps.
TEST(FrictionWork, IsKnownOnTheWayToTheFirstGrowth) {
  CaseSpec spec = plate({0, 0}, {1, 1}, 24, 24);
  for (const double y : {0.21, 0.45, 0.68}) {
    add_crack(spec, {{0.13, y}, {0.46, y + 0.19}});
    add_crack(spec, {{0.54, y - 0.04}, {0.87, y + 0.15}});
  }
  for (CrackSpec& crack : spec.cracks) {
    crack.contact = coulomb(1e7, 1e6, 0.1);
    crack.contact.cohesion = 1.0;
  }
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom), pin = at_point({0, 0});
  top.displacement[1] = proportional_load(-1e-3);
  bottom.displacement[1] = proportional_load(0);
  pin.displacement[0] = proportional_load(0);
  spec.boundaries = {top, bottom, pin};
  spec.solver.tolerance = 1e-10;
  spec.material.toughness = 2.0;
  spec.growth.criterion = Criterion::hoop;
  spec.loading.critical = true;
  spec.loading.max_events = 1;
  const auto at_end = [](const CaseSpec& c) {
    return run_simulation(c, "test", world(), world_partitioner(), {}).steps.back();
  };
  const StepRecord critical = at_end(spec);
  spec.loading.critical = false;
  spec.growth.criterion = Criterion::none;
  spec.load_factors.clear();
  for (int k = 1; k <= 100; ++k) spec.load_factors.push_back(k * critical.load_factor / 100);
  const StepRecord given = at_end(spec);
  EXPECT_GT(given.friction_work, 0.05 * given.external_work);
  EXPECT_NEAR(critical.friction_work, given.friction_work, 0.01 * given.friction_work);
  EXPECT_NEAR(critical.external_work, given.external_work, 0.001 * given.external_work);
  EXPECT_NEAR(critical.dissipated, critical.friction_work, 1e-3 * critical.external_work);
}

class SlidingBlock : public ::testing::TestWithParam<double> {};

/// M4: below the limit the force grows with the move; at it the block slides, whatever more; on the
/// way back it sticks first, and then slides the other way.
TEST_P(SlidingBlock, SticksSlipsAndTurnsRound) {
  Blocks blocks(GetParam());
  constexpr double mu = Blocks::friction, exact = 1e-8;
  EXPECT_NEAR(blocks.force_at(0), 0.0, exact);
  const double first = blocks.force_at(1e-5), second = blocks.force_at(2e-5);
  EXPECT_GT(first, 0.0);
  EXPECT_NEAR(second, 2 * first, 1e-6 * first) << "nothing has slipped yet";
  double before = second;
  for (const double s : {1e-4, 2e-4, 4e-4}) {
    const double now = blocks.force_at(s);
    EXPECT_GT(now, before);
    EXPECT_LE(now, mu + exact);
    before = now;
  }
  double worst = 0.0;
  const auto expect_slip = [&](double s, double limit) {
    const double force = blocks.force_at(s);
    worst = std::max(worst, std::abs(force - limit));
    EXPECT_NEAR(force, limit, exact) << s;
  };
  for (const double s : {4e-3, 5e-3, 9e-3}) expect_slip(s, mu);
  const double back = blocks.force_at(9e-3 - 1e-5);
  EXPECT_LT(back, mu - 0.5 * first) << "sticks at once on the way back";
  EXPECT_GT(back, mu - 1.1 * first);
  for (const double s : {2e-3, 0.0, -1e-3}) expect_slip(s, -mu);
  expect_slip(6e-3, mu);
  std::cout << "sliding forces off by " << worst << " of the pressing one\n";
}

INSTANTIATE_TEST_SUITE_P(Heights, SlidingBlock, ::testing::Values(1.0, 1.04));

/// A fragment behind a tip whose faces touch may be anywhere: its gap says nothing of the tip.
TEST(TouchingTip, IsNotOpenedByFragmentsBehindIt) {
  const Solved s = solved(pressed(13, {{{0.2, 0.45}, {0.62, 0.55}}}, coulomb(4e4, 2e4, 0.6)));
  const auto at_right_tip = [&] {
    for (const StressIntensity& k : s.model->stress_intensities(1.0)) {
      if (k.end == 1) return k;
    }
    return StressIntensity{};
  };
  const StressIntensity closed = at_right_tip();
  ASSERT_TRUE(closed.k1_fitted);
  auto& patches = s.model->contact().patches();
  const std::size_t group = s.model->contact().find(0, 0, {0.62, 0.55})->group;
  cdca::ContactPatch* farthest = nullptr;
  for (auto& p : patches) {
    if (p.group == group && (!farthest || p.from < farthest->from)) farthest = &p;
  }
  farthest->gap.normal = 0.1;
  EXPECT_GT(at_right_tip().k1, 100 * std::abs(closed.k1)) << "the same bodies: the gap counts";
  farthest->bodies[0] += 1;
  const StressIntensity behind = at_right_tip();
  EXPECT_TRUE(behind.k1_fitted);
  EXPECT_LT(std::abs(behind.k1), 2 * std::abs(closed.k1));
}

}  // namespace
}  // namespace cdca::testing
