// SPDX-License-Identifier: BSD-3-Clause
/// What stands in the tables of a checkpoint: columns with their units (see checkpoint_table.hpp).
#pragma once

#include "core/simulation/checkpoint.hpp"

namespace cdca {

inline constexpr auto progress_columns = [](auto&& visit) {
  visit(
      "steps", "", [](auto& r) -> auto& { return r.steps; });
  visit(
      "cycles", "", [](auto& r) -> auto& { return r.cycles; });
  visit(
      "load_factor", "", [](auto& r) -> auto& { return r.load_factor; });
  visit(
      "largest_factor", "", [](auto& r) -> auto& { return r.largest_factor; });
  visit(
      "first_factor", "", [](auto& r) -> auto& { return r.first_factor; });
  visit(
      "joined", "", [](auto& r) -> auto& { return r.joined; });
};

inline constexpr auto energy_columns = [](auto&& visit) {
  visit(
      "external_work", "J/m", [](auto& r) -> auto& { return r.external_work; });
  visit(
      "strain_energy", "J/m", [](auto& r) -> auto& { return r.strain_energy; });
  visit(
      "potential", "J/m", [](auto& r) -> auto& { return r.potential; });
  visit(
      "support_potential", "J/m", [](auto& r) -> auto& { return r.support_potential; });
  visit(
      "factor", "", [](auto& r) -> auto& { return r.factor; });
  visit(
      "friction", "J/m", [](auto& r) -> auto& { return r.friction; });
};

/// A row of history.csv but for the reactions, which are a table of their own.
inline constexpr auto step_columns = [](auto&& visit) {
  visit(
      "step", "", [](auto& r) -> auto& { return r.step; });
  visit(
      "load_factor", "", [](auto& r) -> auto& { return r.load_factor; });
  visit(
      "strain_energy", "J", [](auto& r) -> auto& { return r.strain_energy; });
  visit(
      "crack_length", "m", [](auto& r) -> auto& { return r.crack_length; });
  visit(
      "active_tips", "", [](auto& r) -> auto& { return r.active_tips; });
  visit(
      "growth_cycles", "", [](auto& r) -> auto& { return r.growth_cycles; });
  visit(
      "solver_iterations", "", [](auto& r) -> auto& { return r.solver_iterations; });
  visit(
      "wall_s", "s", [](auto& r) -> auto& { return r.wall_s; });
  visit(
      "external_work", "J", [](auto& r) -> auto& { return r.external_work; });
  visit(
      "dissipated", "J", [](auto& r) -> auto& { return r.dissipated; });
  visit(
      "friction_work", "J", [](auto& r) -> auto& { return r.friction_work; });
  visit(
      "contact_iterations", "", [](auto& r) -> auto& { return r.contact_iterations; });
  visit(
      "contact_unbalanced", "", [](auto& r) -> auto& { return r.contact_unbalanced; });
};

/// A support's force in a step: row i of the steps has the same number of these as every other.
struct ReactionRow {
  int step = 0;
  Vec2 force{0, 0};
};
inline constexpr auto reaction_columns = [](auto&& visit) {
  visit(
      "step", "", [](auto& r) -> auto& { return r.step; });
  visit(
      "force", "N", [](auto& r) -> auto& { return r.force; });
};

inline constexpr auto tip_columns = [](auto&& visit) {
  visit(
      "step", "", [](auto& r) -> auto& { return r.step; });
  visit(
      "cycle", "", [](auto& r) -> auto& { return r.cycle; });
  visit(
      "crack", "", [](auto& r) -> auto& { return r.crack; });
  visit(
      "end", "", [](auto& r) -> auto& { return r.end; });
  visit(
      "at", "m", [](auto& r) -> auto& { return r.at; });
  visit(
      "state", "", [](auto& r) -> auto& { return r.state; });
  visit(
      "partner", "", [](auto& r) -> auto& { return r.partner; });
  visit(
      "K_I", "Pa m^1/2", [](auto& r) -> auto& { return r.k1; });
  visit(
      "K_II", "Pa m^1/2", [](auto& r) -> auto& { return r.k2; });
  visit(
      "K_from", "", [](auto& r) -> auto& { return r.k_from; });
  visit(
      "K_radius", "m", [](auto& r) -> auto& { return r.k_radius; });
  visit(
      "U_tension", "", [](auto& r) -> auto& { return r.u_tension; });
  visit(
      "U_shear", "", [](auto& r) -> auto& { return r.u_shear; });
  visit(
      "angle", "degrees", [](auto& r) -> auto& { return r.angle_deg; });
  visit(
      "mode", "", [](auto& r) -> auto& { return r.mode; });
  visit(
      "growth", "m", [](auto& r) -> auto& { return r.growth; });
};

inline constexpr auto performance_columns = [](auto&& visit) {
  visit(
      "wall_s", "s", [](auto& r) -> auto& { return r.performance.wall_s; });
  visit(
      "setup_s", "s", [](auto& r) -> auto& { return r.performance.setup_s; });
  visit(
      "solve_s", "s", [](auto& r) -> auto& { return r.performance.solve_s; });
  visit(
      "output_s", "s", [](auto& r) -> auto& { return r.performance.output_s; });
  visit(
      "linear_solves", "", [](auto& r) -> auto& { return r.performance.linear_solves; });
  visit(
      "solver_iterations", "", [](auto& r) -> auto& { return r.performance.solver_iterations; });
  visit(
      "step_iterations", "", [](auto& r) -> auto& { return r.step_iterations; });
  visit(
      "step_contact_iterations", "", [](auto& r) -> auto& { return r.step_contact_iterations; });
  visit(
      "step_contact_unbalanced", "", [](auto& r) -> auto& { return r.step_contact_unbalanced; });
};

/// A crack but for its points and ages, which are tables of their own.
inline constexpr auto crack_columns = [](auto&& visit) {
  visit(
      "name", "", [](auto& r) -> auto& { return r.name; });
  visit(
      "start_state", "", [](auto& r) -> auto& { return r.ends[0].state; });
  visit(
      "start_partner", "", [](auto& r) -> auto& { return r.ends[0].partner; });
  visit(
      "start_tip_was", "", [](auto& r) -> auto& { return r.ends[0].tip_was; });
  visit(
      "start_joined_step", "", [](auto& r) -> auto& { return r.ends[0].joined.step; });
  visit(
      "start_joined_cycle", "", [](auto& r) -> auto& { return r.ends[0].joined.cycle; });
  visit(
      "end_state", "", [](auto& r) -> auto& { return r.ends[1].state; });
  visit(
      "end_partner", "", [](auto& r) -> auto& { return r.ends[1].partner; });
  visit(
      "end_tip_was", "", [](auto& r) -> auto& { return r.ends[1].tip_was; });
  visit(
      "end_joined_step", "", [](auto& r) -> auto& { return r.ends[1].joined.step; });
  visit(
      "end_joined_cycle", "", [](auto& r) -> auto& { return r.ends[1].joined.cycle; });
};
struct PointRow {
  int crack = 0;
  Vec2 at{0, 0};
};
inline constexpr auto point_columns = [](auto&& visit) {
  visit(
      "crack", "", [](auto& r) -> auto& { return r.crack; });
  visit(
      "at", "m", [](auto& r) -> auto& { return r.at; });
};
struct SegmentRow {
  int crack = 0;
  GrowthTime born;
};
inline constexpr auto segment_columns = [](auto&& visit) {
  visit(
      "crack", "", [](auto& r) -> auto& { return r.crack; });
  visit(
      "age", "", [](auto& r) -> auto& { return r.born.step; });
  visit(
      "cycle", "", [](auto& r) -> auto& { return r.born.cycle; });
};

inline constexpr auto event_columns = [](auto&& visit) {
  visit(
      "step", "", [](auto& r) -> auto& { return r.step; });
  visit(
      "cycle", "", [](auto& r) -> auto& { return r.cycle; });
  visit(
      "kind", "", [](auto& r) -> auto& { return r.kind; });
  visit(
      "crack", "", [](auto& r) -> auto& { return r.crack; });
  visit(
      "end", "", [](auto& r) -> auto& { return r.end; });
  visit(
      "partner", "", [](auto& r) -> auto& { return r.partner; });
  visit(
      "at", "m", [](auto& r) -> auto& { return r.at; });
};

inline constexpr auto patch_columns = [](auto&& visit) {
  visit(
      "crack", "", [](auto& r) -> auto& { return r.crack; });
  visit(
      "segment", "", [](auto& r) -> auto& { return r.segment; });
  visit(
      "from", "", [](auto& r) -> auto& { return r.from; });
  visit(
      "to", "", [](auto& r) -> auto& { return r.to; });
  visit(
      "length", "m", [](auto& r) -> auto& { return r.length; });
  visit(
      "slip", "m", [](auto& r) -> auto& { return r.slip; });
  visit(
      "largest_opening", "m", [](auto& r) -> auto& { return r.largest; });
  visit(
      "tangential_before", "Pa", [](auto& r) -> auto& { return r.tangential; });
  visit(
      "state", "", [](auto& r) -> auto& { return r.now.state; });
  visit(
      "normal", "Pa", [](auto& r) -> auto& { return r.now.normal; });
  visit(
      "tangential", "Pa", [](auto& r) -> auto& { return r.now.tangential; });
  visit(
      "normal_spring", "Pa/m", [](auto& r) -> auto& { return r.now.normal_spring; });
  visit(
      "tangential_spring", "Pa/m", [](auto& r) -> auto& { return r.now.tangential_spring; });
  visit(
      "largest_opening_now", "m", [](auto& r) -> auto& { return r.now.largest; });
  visit(
      "normal_gap", "m", [](auto& r) -> auto& { return r.gap.normal; });
  visit(
      "tangential_gap", "m", [](auto& r) -> auto& { return r.gap.tangential; });
  visit(
      "friction_limit", "Pa", [](auto& r) -> auto& { return r.limit; });
};

}  // namespace cdca
