// SPDX-License-Identifier: BSD-3-Clause
/// What growth and turning springs take over from before is, to the last bit, what would be made
/// anew.
#include "core/cells/carried_cells.hpp"

#include "core/cracks/meetings.hpp"
#include "tests/cracked_plates.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cdca::testing {
namespace {

/// Rows and windows of every scale, as far as they can be seen.
struct Scales {
  std::vector<StiffnessRows> rows;
  std::vector<std::vector<double>> moves, forces;
};

Scales scales_of(const Model& model) {
  Scales all;
  for (std::size_t k = 0; k < model.hierarchy().count(); ++k) {
    const Scale& scale = model.hierarchy().scale(k);
    const auto& cells = dynamic_cast<const CellStiffness&>(scale.cells());
    all.rows.push_back(cells.rows());
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> any(-1, 1);
    std::vector<double> forces(std::size_t(cells.count()), 0.0), moves(forces);
    for (LocalId u = 0; u < cells.owned(); ++u) forces[std::size_t(u)] = any(engine);
    cells.clear_held(forces);
    if (k + 1 < model.hierarchy().count()) {
      scale.move_windows(SweepDirection::forward, forces, moves);
    } else {
      scale.solve(forces, moves);
    }
    all.moves.push_back(moves);
    all.forces.push_back(forces);
  }
  return all;
}

/// As after all is built anew.
void expect_as_built_anew(Model& model, double weak_share = 1e-3) {
  const Scales carried = scales_of(model);
  model.build_stiffness(weak_share);
  const Scales anew = scales_of(model);
  for (std::size_t k = 0; k < anew.rows.size(); ++k) {
    EXPECT_EQ(carried.rows[k].unknown, anew.rows[k].unknown) << "scale " << k;
    EXPECT_EQ(carried.rows[k].start, anew.rows[k].start) << "scale " << k;
    EXPECT_EQ(carried.rows[k].column, anew.rows[k].column) << "scale " << k;
    EXPECT_EQ(carried.rows[k].value, anew.rows[k].value) << "scale " << k;
    EXPECT_EQ(carried.moves[k], anew.moves[k]) << "scale " << k;
    EXPECT_EQ(carried.forces[k], anew.forces[k]) << "scale " << k;
  }
}

void expect_as_built_anew(Model& model, const CrackRegistry& registry) {
  model.lay_cracks(registry);
  expect_as_built_anew(model);
}

/// Every other active tip goes on by about an element, in any direction ahead.
CrackRegistry grown(const Model& model, std::mt19937& engine) {
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Increment> increments;
  for (std::size_t c = 0; c < model.registry().cracks().size(); ++c) {
    const Crack& crack = model.registry().cracks()[c];
    for (int end = 0; end < 2; ++end) {
      const double length = (1.0 + 0.5 * any(engine)) * model.grid().smallest_side();
      const double angle = 0.5 * any(engine);
      if (crack.ends[std::size_t(end)].state != TipState::active || any(engine) < 0) continue;
      const Vec2 from = crack.end_point(end);
      increments.push_back({int(c), end, from,
                            from + length * (Eigen::Rotation2Dd(angle) * crack.end_tangent(end))});
    }
  }
  increments = resolve_meetings(model.registry(), model.body(), model.touch_distance(),
                                std::move(increments));
  CrackRegistry registry = model.registry();
  apply_increments(increments, model.touch_distance(), {1, 0}, registry);
  return registry;
}

class CarriedCellsParallel : public ::testing::TestWithParam<int> {
 protected:
  static CaseSpec plate_number(int number) {
    CaseSpec spec = plates()[std::size_t(number)];
    in_scales_of(spec, 60);
    return spec;
  }

 private:
  static std::vector<CaseSpec> plates() {
    CaseSpec wide = plate_of(31, 63, three_cracks(), Pull::by_traction);
    wide.tip_radius = 3.5 / 31;
    return {plate_of(40, 80, three_cracks()), wide, plate_of(31, 63, crossing(), Pull::by_traction),
            plate_of(27, 55, cracks_apart(20, 0.05, 3)), plate_of(33, 65, nearly_severing())};
  }
};

TEST_P(CarriedCellsParallel, GrowthAndBack) {
  Model model(plate_number(GetParam()), world(), world_partitioner());
  model.build_stiffness();
  const CrackRegistry first = model.registry();
  std::mt19937 engine(11);
  for (int cycle = 0; cycle < 6; ++cycle) {
    SCOPED_TRACE(cycle);
    const CrackRegistry before = model.registry();
    const CrackRegistry now = grown(model, engine);
    expect_as_built_anew(model, now);
    if (cycle % 3 == 1) {
      expect_as_built_anew(model, before);
      expect_as_built_anew(model, now);
    }
  }
  expect_as_built_anew(model, first);
}

INSTANTIATE_TEST_SUITE_P(Plates, CarriedCellsParallel, ::testing::Range(0, 5));

/// Stiff faces that touch at first.
CaseSpec with_faces(CaseSpec spec) {
  const double stiffness = 1e3 * spec.material.young / spec.domain.size.x() * spec.domain.cells[0];
  for (CrackSpec& crack : spec.cracks)
    crack.contact = {ContactLaw::coulomb, stiffness, 0.1 * stiffness, 0.3, 0, 0, 0};
  return spec;
}

class CarriedFacesParallel : public ::testing::TestWithParam<int> {
 protected:
  static CaseSpec plate_number(int number) {
    CaseSpec spec = with_faces(plates()[std::size_t(number)]);
    in_scales_of(spec, number == 1 ? 100000 : 60);
    return spec;
  }
  /// About one face in ten opens, closes or begins to slide.
  static void turn_some(Model& model, std::mt19937& engine) {
    std::uniform_real_distribution<double> any(0, 1);
    for (ContactPatch& p : model.contact().patches()) {
      if (any(engine) > 0.1) continue;
      const ContactAnswer closed = touching(model.contact().law_of(p));
      p.now = any(engine) < 0.4 ? ContactAnswer() : closed;
      if (any(engine) < 0.4) p.now.tangential_spring = 0.0;
    }
  }

 private:
  static std::vector<CaseSpec> plates() {
    // a crack along grid lines, with a tip near one of another; and one with a wide zone
    const Cracks along{{{.25, 1.0}, {.75, 1.0}}, {{.6, 1.08}, {.9, 1.3}}};
    CaseSpec wide = plate_of(32, 64, along);
    wide.tip_radius = 2.5 / 32;
    return {plate_of(32, 64, along), plate_of(20, 40, three_cracks()), wide,
            plate_of(27, 55, cracks_apart(20, 0.05, 3)), plate_of(33, 65, nearly_severing())};
  }
};

TEST_P(CarriedFacesParallel, TurnAndGrow) {
  Model model(plate_number(GetParam()), world(), world_partitioner());
  model.build_stiffness();
  std::mt19937 engine(5);
  for (int cycle = 0; cycle < 6; ++cycle) {
    SCOPED_TRACE(cycle);
    const double weak_share = cycle % 3 == 0 ? 1e-3 : 0.3;
    model.hold_all_bodies(cycle >= 2 && cycle <= 4);
    turn_some(model, engine);
    model.renew_stiffness(weak_share);
    expect_as_built_anew(model, weak_share);
    turn_some(model, engine);
    expect_as_built_anew(model, grown(model, engine));
  }
}

INSTANTIATE_TEST_SUITE_P(Plates, CarriedFacesParallel, ::testing::Range(0, 5));

/// Of a plate in which one face opens, cells far from it are as they were.
TEST(CarriedFaces, MostCellsAreTheSame) {
  CaseSpec spec = with_faces(plate_of(60, 120, three_cracks()));
  in_scales_of(spec, 2000);
  const auto model = built(spec);
  const std::int64_t all = model->hierarchy().factors().made();
  model->contact().patches()[3].now = ContactAnswer();
  model->renew_stiffness(1e-3);
  EXPECT_LT(model->hierarchy().factors().made(), all / 3);
  EXPECT_GT(model->hierarchy().factors().reused(), all / 3);
}

/// What resists the motion of bodies is the same whatever their faces do; otherwise turns that end
/// with the drag in balance would aim at something else each time.
TEST(CarriedFaces, DragStaysWhileFacesTurn) {
  const auto model = built(with_faces(plate_of(20, 40, three_cracks())));
  model->hold_all_bodies(true);
  const auto drags = [&] {
    std::vector<double> found;
    model->renew_stiffness(0.1);
    for (const auto& spring : model->stiffness().springs()) found.push_back(spring.stiffness);
    return found;
  };
  const auto touching_faces = drags();
  for (ContactPatch& p : model->contact().patches()) p.now = ContactAnswer();
  EXPECT_EQ(drags(), touching_faces);
  EXPECT_GT(touching_faces.size(), 1600U) << "of all cells";
}

/// Of a plate in which one tip grows, cells far from it are as they were.
TEST(CarriedCells, MostCellsAreTheSame) {
  const auto model = built(plate_of(60, 120, three_cracks()));
  CrackRegistry registry = model->registry();
  const Crack& crack = registry.cracks()[0];
  registry.advance(0, 1, crack.end_point(1) + crack.end_tangent(1) / 60, TipState::active, -1,
                   {1, 0});
  const std::int64_t all = model->hierarchy().factors().made();
  model->lay_cracks(registry);
  EXPECT_LT(model->hierarchy().factors().made(), all / 3);
  EXPECT_GT(model->hierarchy().factors().reused(), all / 3);
}

}  // namespace
}  // namespace cdca::testing
