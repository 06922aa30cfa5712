// SPDX-License-Identifier: BSD-3-Clause
/// Plates with many cracks of all kinds, to try solvers on.
#pragma once

#include "tests/plates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace cdca::testing {

using Cracks = std::vector<std::vector<Vec2>>;

/// How a plate is loaded: top and bottom moved apart, or tractions on all sides with no more than
/// three unknowns held.
enum class Pull { by_displacement, by_traction };

/// 1 wide; cells are square when ny / nx = height.
inline CaseSpec plate_of(int nx, int ny, const Cracks& cracks, Pull how = Pull::by_displacement,
                         double height = 2.0) {
  CaseSpec spec = plate({0, 0}, {1, height}, nx, ny);
  spec.solver.tolerance = 1e-8;
  for (const auto& points : cracks) add_crack(spec, points);
  if (how == Pull::by_traction) {
    pull(spec, {0.3, 1.0, 0.2});
    return spec;
  }
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom), pin = at_point({0, 0});
  top.displacement[1] = proportional_load(1e-3);
  bottom.displacement[1] = proportional_load(0);
  pin.displacement[0] = proportional_load(0);
  spec.boundaries = {top, bottom, pin};
  return spec;
}

inline Cracks one_crack() { return {{{.3012, 1.003}, {.7031, 1.0511}}}; }

inline Cracks three_cracks() {
  return {{{.2012, .503}, {.5031, .6511}}, {{.5, 1.1}, {.8, .95}}, {{.2, 1.503}, {.6031, 1.7511}}};
}

/// Random cracks that keep apart by `gap`, up to the rim at most.
inline Cracks cracks_apart(int count, double gap, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> any(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * any(engine); };
  Cracks cracks;
  const auto apart = [&](const Vec2& a, const Vec2& b) {
    return std::all_of(cracks.begin(), cracks.end(), [&](const std::vector<Vec2>& other) {
      for (double s = 0; s <= 1; s += 0.1) {
        for (double t = 0; t <= 1; t += 0.1) {
          if ((a + s * (b - a) - other[0] - t * (other[1] - other[0])).norm() < gap) return false;
        }
      }
      return true;
    });
  };
  while (int(cracks.size()) < count) {
    const Vec2 middle(between(0.1, 0.9), between(0.1, 1.9));
    const double length = between(0.05, 0.15), angle = between(0, std::numbers::pi);
    const Vec2 half = 0.5 * length * Vec2(std::cos(angle), std::sin(angle));
    if (apart(middle - half, middle + half)) cracks.push_back({middle - half, middle + half});
  }
  return cracks;
}

inline Cracks fifty_cracks() { return cracks_apart(50, 0.03, 7); }

/// Five cracks that cross one another and leave no loose part.
inline Cracks crossing() {
  return {{{.1, .55}, {.9, 1.35}},
          {{.15, 1.4}, {.85, .5}},
          {{.5, .2}, {.53, .8}},
          {{.15, .83}, {.4, .7}},
          {{.55, 1.55}, {.9, 1.1}}};
}

/// Cracks from both sides that leave ligaments of a twentieth of the width, and cracks across the
/// bridges between them.
inline Cracks nearly_severing() {
  return {{{0, .6}, {.951, .63}}, {{1, .9}, {.05, .87}},    {{0, 1.2}, {.953, 1.17}},
          {{.3, .7}, {.7, .78}},  {{.31, 1.1}, {.72, .95}}, {{.5, 1.3}, {.52, 1.9}}};
}

/// Random cracks that may cross, touch, run together and end on the rim.
inline Cracks network(int count, double longest, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> any(0, 1);
  Cracks cracks;
  while (int(cracks.size()) < count) {
    const Vec2 middle(any(engine), 2 * any(engine));
    const double length = longest * (0.3 + 0.7 * any(engine));
    const double angle = std::numbers::pi * any(engine);
    const Vec2 half = 0.5 * length * Vec2(std::cos(angle), std::sin(angle));
    const auto inside = [](const Vec2& x) { return Vec2(x.cwiseMax(0).cwiseMin(Vec2(1, 2))); };
    const Vec2 a = inside(middle - half), b = inside(middle + half);
    if ((b - a).norm() > 0.25 * longest) cracks.push_back({a, b});
  }
  return cracks;
}

/// A plate that gets all of its cracks after it was made, as in growth: they may cut off fragments.
inline Solved solved_as_grown(CaseSpec spec) {
  CrackRegistry registry;
  for (const CrackSpec& crack : spec.cracks) registry.add(crack.name, crack.points);
  spec.cracks.clear();
  Solved s;
  s.model = built(spec);
  registry.resolve_initial_meetings(s.model->body(), s.model->touch_distance());
  s.model->lay_cracks(registry);
  s.equilibrium = find_equilibrium(*s.model, *make_solver(*s.model), 1.0);
  return s;
}

}  // namespace cdca::testing
