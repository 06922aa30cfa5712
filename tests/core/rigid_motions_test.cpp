// SPDX-License-Identifier: BSD-3-Clause
/// What is left of displacements without the motions of loose bodies.
#include "core/cells/rigid_motions.hpp"

#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cdca::testing {
namespace {

/// A plate that a crack cuts into a held half and one that only touches it; this has a crack of two
/// elements, which is less than the domain of its K reaches.
CaseSpec halves() {
  CaseSpec spec = plate({0, 0}, {1, 1}, 26, 26);
  add_crack(spec, {{0, 0.48}, {1, 0.53}});
  spec.cracks.back().contact = {ContactLaw::frictionless, 1e6, 0, 0, 0, 0, 0};
  add_crack(spec, {{0.31, 0.75}, {0.38, 0.77}});
  BoundarySpec bottom = on_side(Side::bottom);
  bottom.displacement = constant_load(0, 0);
  spec.boundaries = {bottom};
  return spec;
}

/// Of the pieces of bodies that nothing holds.
void move(Model& model, const Vec2& shift, double angle) {
  const CellUnknowns& unknowns = model.unknowns();
  for (LocalId n = 0; n < model.mesh().node_count(); ++n) {
    const Vec2 x = model.grid().node_position(model.mesh().node(n));
    const Vec2 u = shift + angle * turned_left(x);
    for (int p = 0; p < unknowns.pieces(n); ++p) {
      if (model.bodies().list()[model.bodies().body_of(n, p)].held) continue;
      const auto k = std::size_t(unknowns.of_piece(n, p));
      model.state()[k] += u.x();
      model.state()[k + 1] += u.y();
    }
  }
}

TEST(RigidMotionsParallel, AreTakenOutOfLooseBodiesOnly) {
  const auto model = built(halves());
  std::vector<double>& state = model->state();
  for (std::size_t k = 0; k < state.size(); ++k) state[k] = 1e-3;  // the same on every rank
  const std::vector<double> before = state;
  move(*model, {0.3, -0.2}, 0.7);
  EXPECT_NE(state, before);
  const auto rest = without_rigid_motions(model->basis(), model->bodies(), state, world());
  for (LocalId n = 0; n < model->mesh().node_count(); ++n) {
    for (int p = 0; p < model->unknowns().pieces(n); ++p) {
      const auto k = std::size_t(model->unknowns().of_piece(n, p));
      const bool held = model->bodies().list()[model->bodies().body_of(n, p)].held;
      EXPECT_NEAR(rest[k], held ? 1e-3 : 0.0, 1e-14);
      EXPECT_NEAR(rest[k + 1], held ? 1e-3 : 0.0, 1e-14);
    }
  }
}

/// K of a tip does not know how far its body has turned.
TEST(RigidMotionsParallel, LeaveIntensitiesAsTheyWere) {
  const auto model = built(halves());
  std::fill(model->state().begin(), model->state().end(), 0.0);
  move(*model, {2, 1}, 1.0);
  const auto tips = model->stress_intensities(1.0);
  ASSERT_EQ(tips.size(), 2u);
  for (const StressIntensity& k : tips) {
    EXPECT_LT(std::abs(k.k1), 1e-9);
    EXPECT_LT(std::abs(k.k2), 1e-9);
  }
}

}  // namespace
}  // namespace cdca::testing
