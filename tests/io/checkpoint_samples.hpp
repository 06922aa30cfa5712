// SPDX-License-Identifier: BSD-3-Clause
/// A checkpoint in which everything has another value.
#pragma once

#include "core/simulation/checkpoint.hpp"
#include "io/checkpoint_file.hpp"
#include "tests/io/output_samples.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cdca::testing {

inline CheckpointOrigin sample_origin() {
  return {"0.1.0", "A plate, größer", "title = \"A plate\"\n[domain]\nsize = [1.0, 2.0]\n"};
}

/// Cells first, first + 1, ..., last - 1, of which every third has ten unknowns and the others two.
inline CellFields sample_cells(std::int64_t first, std::int64_t last) {
  CellFields cells;
  for (std::int64_t node = first; node < last; ++node) {
    const std::int64_t count = node % 3 == 0 ? 10 : 2;
    cells.nodes.push_back(node);
    cells.counts.push_back(count);
    for (std::int64_t i = 0; i < count; ++i) {
      cells.displacement.push_back(1e-6 * double(node) + 1e-3 * double(i) / 3.0);
      cells.force.push_back(-1e5 * double(node) - double(i) / 7.0);
    }
  }
  return cells;
}

inline Checkpoint sample_checkpoint() {
  Checkpoint c;
  c.progress = {2, 3, 0.75, 0.875, 0.5, false};
  const Summary summary = sample_summary();
  c.story = {summary.steps, summary.tips, {summary.tips[1]}, summary.performance, 17, 5, 1e-9};
  c.story.steps[1].external_work = 1.0 / 3.0;
  c.story.steps[1].dissipated = -2.0 / 3.0;
  c.story.cycle_tips[0].mode = "hoop";
  c.story.cycle_tips[0].k2 = std::numeric_limits<double>::infinity();
  c.energy = {1.5, 2.5, 3.5, 4.5, 5.5};
  Crack bent;
  bent.name = "Riß, der erste";
  bent.points = {{0.1, 0.2}, {0.3, 0.4 + 1e-17}, {1.0 / 3.0, 0.6}};
  bent.born = {{0, 0}, {2, 1}};
  bent.ends = {CrackEnd{TipState::boundary, -1, -1, {}},
               CrackEnd{TipState::coalesced, 1, 1, {2, 1}}};
  Crack other;
  other.name = "b";
  other.points = {{-0.1, 1e-9}, {0.5, 0.5}};
  other.born = {{0, 0}};
  c.cracks = {bent, other};
  c.events = {{0, 0, EventKind::crossing, 0, -1, 1, {0.25, 0.125}},
              {2, 1, EventKind::coalescence, 0, 1, 1, {1.0 / 3.0, 0.6}}};
  ContactPatch patch{1, 0, 0.25, 0.5, 0.1, 0, {}, {3e-6, -4e-6}, 2e4, 1e-5, 2e-5, 1e4};
  patch.now = {ContactState::slip, -1e5, 2e4, 4e13, 4e11, 0.0, 0.0, 6e-5};
  c.patches = {patch};
  return c;
}

inline void expect_same(const TipRecord& a, const TipRecord& b) {
  EXPECT_EQ(std::tie(a.step, a.cycle, a.crack, a.end, a.at, a.state, a.partner, a.k1, a.k2,
                     a.k_from, a.k_radius, a.u_tension, a.u_shear, a.angle_deg, a.mode, a.growth),
            std::tie(b.step, b.cycle, b.crack, b.end, b.at, b.state, b.partner, b.k1, b.k2,
                     b.k_from, b.k_radius, b.u_tension, b.u_shear, b.angle_deg, b.mode, b.growth));
}

inline void expect_same(const RunStory& a, const RunStory& b) {
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t k = 0; k < a.steps.size(); ++k) {
    const StepRecord &s = a.steps[k], &t = b.steps[k];
    EXPECT_EQ(
        std::tie(s.step, s.load_factor, s.reactions, s.strain_energy, s.crack_length, s.active_tips,
                 s.growth_cycles, s.solver_iterations, s.wall_s, s.external_work, s.dissipated),
        std::tie(t.step, t.load_factor, t.reactions, t.strain_energy, t.crack_length, t.active_tips,
                 t.growth_cycles, t.solver_iterations, t.wall_s, t.external_work, t.dissipated));
  }
  ASSERT_EQ(a.tips.size(), b.tips.size());
  for (std::size_t k = 0; k < a.tips.size(); ++k) expect_same(a.tips[k], b.tips[k]);
  ASSERT_EQ(a.cycle_tips.size(), b.cycle_tips.size());
  for (std::size_t k = 0; k < a.cycle_tips.size(); ++k)
    expect_same(a.cycle_tips[k], b.cycle_tips[k]);
  const PerformanceRecord &p = a.performance, &q = b.performance;
  EXPECT_EQ(
      std::tie(p.wall_s, p.setup_s, p.solve_s, p.output_s, p.linear_solves, p.solver_iterations,
               a.step_iterations, a.step_contact_iterations, a.step_contact_unbalanced),
      std::tie(q.wall_s, q.setup_s, q.solve_s, q.output_s, q.linear_solves, q.solver_iterations,
               b.step_iterations, b.step_contact_iterations, b.step_contact_unbalanced));
}

/// All but the cells.
inline void expect_same(const Checkpoint& a, const Checkpoint& b) {
  EXPECT_EQ(std::tie(a.progress.steps, a.progress.cycles, a.progress.load_factor,
                     a.progress.largest_factor, a.progress.first_factor, a.progress.joined),
            std::tie(b.progress.steps, b.progress.cycles, b.progress.load_factor,
                     b.progress.largest_factor, b.progress.first_factor, b.progress.joined));
  expect_same(a.story, b.story);
  EXPECT_EQ(std::tie(a.energy.external_work, a.energy.strain_energy, a.energy.potential,
                     a.energy.support_potential, a.energy.factor),
            std::tie(b.energy.external_work, b.energy.strain_energy, b.energy.potential,
                     b.energy.support_potential, b.energy.factor));
  EXPECT_EQ(CrackRegistry(a.cracks, a.events).hash(), CrackRegistry(b.cracks, b.events).hash());
  ASSERT_EQ(a.cracks.size(), b.cracks.size());
  for (std::size_t k = 0; k < a.cracks.size(); ++k) EXPECT_EQ(a.cracks[k].name, b.cracks[k].name);
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t k = 0; k < a.events.size(); ++k) {
    const Event &e = a.events[k], &f = b.events[k];
    EXPECT_EQ(std::tie(e.step, e.cycle, e.kind, e.crack, e.end, e.partner, e.at),
              std::tie(f.step, f.cycle, f.kind, f.crack, f.end, f.partner, f.at));
  }
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t k = 0; k < a.patches.size(); ++k) {
    const ContactPatch &p = a.patches[k], &q = b.patches[k];
    EXPECT_EQ(
        std::tie(p.crack, p.segment, p.from, p.to, p.length, p.limit, p.slip, p.largest,
                 p.tangential, p.gap.normal, p.gap.tangential, p.now.state, p.now.normal,
                 p.now.tangential, p.now.normal_spring, p.now.tangential_spring, p.now.largest),
        std::tie(q.crack, q.segment, q.from, q.to, q.length, q.limit, q.slip, q.largest,
                 q.tangential, q.gap.normal, q.gap.tangential, q.now.state, q.now.normal,
                 q.now.tangential, q.now.normal_spring, q.now.tangential_spring, q.now.largest));
  }
}

}  // namespace cdca::testing
