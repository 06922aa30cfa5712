// SPDX-License-Identifier: BSD-3-Clause
/// What a case file says, in plain values with SI units; the text and its syntax stay in io/.
#pragma once

#include "core/mechanics/boundary_spec.hpp"
#include "core/mechanics/contact_law.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace cdca {

struct DomainSpec {
  Vec2 size{0, 0};                 ///< m
  Vec2 origin{0, 0};               ///< m, lower left corner
  std::array<int, 2> cells{0, 0};  ///< elements in x and y
  double thickness = 1.0;          ///< m
  bool plane_strain = false;
  LoadVector body_force;  ///< N/m^3
  int line = 0;
};

struct MaterialSpec {
  double young = 0.0;  ///< Pa
  double poisson = 0.0;
  std::optional<double> tensile_strength;  ///< Pa
  std::optional<double> cohesion;          ///< Pa
  std::optional<double> friction_angle;    ///< degrees
  std::optional<double> toughness;         ///< Pa m^1/2, mode I
  int line = 0;
};

/// An initial crack: an open polyline.
struct CrackSpec {
  std::string name;
  std::vector<Vec2> points;  ///< m, at least two
  int line = 0;
  ContactSpec contact{};  ///< of its faces, those that it grows included
};

/// Of its polyline, m.
double length_of(const CrackSpec& crack);

enum class SolverMethod { relaxation, krylov, multilevel };

struct SolverSpec {
  SolverMethod method = SolverMethod::multilevel;
  /// Multilevel: a scale with no more nodes than this is solved directly.
  std::int64_t coarsest_nodes = 2000;
  /// The same where faces may touch: what moves all cells at once also condenses the body to them.
  std::int64_t coarsest_touching = 10000;
  /// The same, where this is more, where faces are many: at first an element of a crack that may
  /// touch for every hundred nodes.
  int condensed_nodes = 50000;
  double tolerance = 1e-8;       ///< relative residual
  double over_relaxation = 1.0;  ///< of the rule, 0 < value < 2; relaxation only
  int max_iterations = 0;        ///< 0: chosen from the size of the problem
};

enum class Criterion { none, hoop, mixed };

/// When, where to and how far tips grow.
struct GrowthSpec {
  Criterion criterion = Criterion::none;
  double radius = 0.0;      ///< r0, m; 0: chosen from the material and the grid
  bool full_field = false;  ///< stresses on the arc from the whole field, not from K_I and K_II
  bool literal = false;     ///< no scaling of r0 to the toughness
  bool fixed_step = false;  ///< otherwise as far as the stress would still break the material
  std::array<double, 2> step_length{1.0, 4.0};  ///< limits; equal for a fixed step
  bool step_in_metres = false;                  ///< otherwise in (smaller) element sides
  bool corrected = true;  ///< directions are corrected until the new segment ends with K_II near 0
  int cycles = 200;       ///< most growth cycles in one load step
  int line = 0;
};

/// Load steps as given, or the load factor at which the next tip grows.
struct LoadingSpec {
  bool critical = false;
  int max_events = 500;      ///< critical mode: growth events
  double min_factor = 0.05;  ///< critical mode: ends below this part of the largest factor reached
};

struct OutputSpec {
  int every = 1;              ///< load steps between field files
  int checkpoint_every = 10;  ///< load steps between checkpoints; 0: none
  bool pictures = true;
};

struct CaseSpec {
  std::string file;  ///< as given by the user, for messages
  std::string title;
  std::string effective;  ///< the whole input with every default filled in, as a case file
  DomainSpec domain;
  MaterialSpec material;
  double tip_radius = 0.0;  ///< m; 0: the nodes of the tip element only
  std::vector<CrackSpec> cracks;
  std::vector<BoundarySpec> boundaries;
  std::vector<double> load_factors{1.0};  ///< of every load step, in order; prescribed mode
  LoadingSpec loading;
  GrowthSpec growth;
  SolverSpec solver;
  OutputSpec output;
};

}  // namespace cdca
