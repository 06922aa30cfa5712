// SPDX-License-Identifier: BSD-3-Clause
/// What a case file says, in plain values with SI units; the text and its syntax stay in io/.
#pragma once

#include "core/mechanics/boundary_spec.hpp"

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
};

enum class SolverMethod { relaxation, krylov };

struct SolverSpec {
  SolverMethod method = SolverMethod::krylov;
  double tolerance = 1e-8;       ///< relative residual
  double over_relaxation = 1.0;  ///< of the rule, 0 < value < 2; relaxation only
  int max_iterations = 0;        ///< 0: chosen from the size of the problem
};

struct OutputSpec {
  int every = 1;  ///< load steps between field files
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
  std::vector<double> load_factors{1.0};  ///< the factor of every load step, in order
  SolverSpec solver;
  OutputSpec output;
};

}  // namespace cdca
