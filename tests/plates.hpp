// SPDX-License-Identifier: BSD-3-Clause
/// Cases for tests, made without a case file.
#pragma once

#include "core/simulation/equilibrium.hpp"
#include "tests/world.hpp"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cdca::testing {

inline LoadValue function_load(std::function<double(double, double)> f) {
  return {[f = std::move(f)](double x, double y, double) { return f(x, y); }, false, "f"};
}

using Field = std::function<Vec2(const Vec2&)>;

inline LoadVector field_load(const Field& f) {
  return {function_load([f](double x, double y) { return f(Vec2(x, y)).x(); }),
          function_load([f](double x, double y) { return f(Vec2(x, y)).y(); })};
}

inline LoadVector constant_load(double x, double y) {
  return {proportional_load(x), proportional_load(y)};
}

/// E = 1000, nu = 0.3, plane strain, tolerance 1e-12 unless the test changes it.
inline CaseSpec plate(const Vec2& lower, const Vec2& upper, int nx, int ny) {
  CaseSpec spec;
  spec.domain.origin = lower;
  spec.domain.size = upper - lower;
  spec.domain.cells = {nx, ny};
  spec.domain.plane_strain = true;
  spec.material.young = 1000.0;
  spec.material.poisson = 0.3;
  spec.solver.tolerance = 1e-12;
  return spec;
}

/// The last scale has no more nodes than this, however many faces touch.
inline void in_scales_of(CaseSpec& spec, std::int64_t nodes) {
  SolverSpec& solver = spec.solver;
  solver.coarsest_nodes = solver.coarsest_touching = nodes;
  solver.condensed_nodes = 0;
}

inline void add_crack(CaseSpec& spec, std::vector<Vec2> points) {
  const std::string name = "crack" + std::to_string(spec.cracks.size() + 1);
  spec.cracks.push_back({name, std::move(points), 0});
}

inline BoundarySpec on_side(Side side) {
  BoundarySpec b;
  b.kind = BoundaryKind::side;
  b.side = side;
  b.name = "side";
  return b;
}

inline BoundarySpec at_point(const Vec2& x) {
  BoundarySpec b;
  b.kind = BoundaryKind::point;
  b.at = x;
  b.name = "point";
  return b;
}

constexpr Side all_sides[] = {Side::left, Side::right, Side::bottom, Side::top};

/// Prescribes u = f on the whole rim.
inline void hold_rim(CaseSpec& spec, const Field& f) {
  for (const Side side : all_sides) {
    BoundarySpec b = on_side(side);
    b.displacement = field_load(f);
    spec.boundaries.push_back(b);
  }
}

/// Loads all four sides with the tractions of a constant stress (xx, yy, xy) and stops rigid
/// motions at two corners.
inline void pull(CaseSpec& spec, const Voigt& s) {
  const Vec2 traction[] = {{-s[0], -s[2]}, {s[0], s[2]}, {-s[2], -s[1]}, {s[2], s[1]}};
  for (std::size_t k = 0; k < 4; ++k) {
    BoundarySpec b = on_side(all_sides[k]);
    b.traction = constant_load(traction[k].x(), traction[k].y());
    spec.boundaries.push_back(b);
  }
  const Vec2 lower = spec.domain.origin;
  BoundarySpec pin = at_point(lower);
  pin.displacement = constant_load(0, 0);
  BoundarySpec roller = at_point(lower + Vec2(spec.domain.size.x(), 0));
  roller.displacement[1] = proportional_load(0);
  spec.boundaries.push_back(pin);
  spec.boundaries.push_back(roller);
}

/// A model with its stiffness, on the ranks of the test.
inline std::unique_ptr<Model> built(const CaseSpec& spec) {
  auto model = std::make_unique<Model>(spec, world(), world_partitioner());
  model->build_stiffness();
  return model;
}

struct Solved {
  std::unique_ptr<Model> model;
  Equilibrium equilibrium;
};

/// Equilibrium at load factor 1.
inline Solved solved(const CaseSpec& spec) {
  Solved s;
  s.model = built(spec);
  s.equilibrium = find_equilibrium(*s.model, *make_solver(*s.model), 1.0);
  return s;
}

}  // namespace cdca::testing
