// SPDX-License-Identifier: BSD-3-Clause
/// What a run shows to its observers: plain values, so that writers need not know how they were
/// computed.
#pragma once

#include "core/base/types.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cdca {

/// The part of the body that one rank draws. Elements cut by cracks are split into polygons whose
/// points are not shared across the crack, so that cracks open when the points are displaced.
struct FieldPart {
  std::vector<double> points;        ///< x, y of every point, m
  std::vector<double> displacement;  ///< u_x, u_y of every point, m
  std::vector<std::int64_t> offsets{
      0};  ///< polygon p has points connectivity[offsets[p]..offsets[p+1])
  std::vector<std::int64_t> connectivity;  ///< counter-clockwise
  std::vector<double> stress;              ///< xx, yy, zz, xy of every polygon, Pa, at its centroid
  std::vector<double>
      principal;              ///< in-plane principal stresses of every polygon, larger first, Pa
  std::vector<double> young;  ///< Pa
  std::vector<std::int64_t> element;  ///< global id of the element that the polygon is a part of
  std::vector<int> kind;              ///< 0 continuous, 1 cut, 2 tip, 3 junction
  std::vector<int> pieces;            ///< parts into which the cracks cut the element
  std::vector<int> owner;             ///< rank
};

/// The crack faces that one rank draws: short straight lines, two points each.
struct CrackPart {
  std::vector<double> points;               ///< x, y: two points a line, undeformed, m
  std::vector<int> crack;                   ///< number of the crack, per line
  std::vector<int> age;                     ///< load step in which the line appeared
  std::vector<double> opening;              ///< normal jump at every point, m, open positive
  std::vector<double> slip;                 ///< tangential jump at every point, m
  std::vector<int> contact_state;           ///< per line: 0 open, 1 stick, 2 slip
  std::vector<double> normal_traction;      ///< per line, Pa, tension positive
  std::vector<double> tangential_traction;  ///< per line, Pa
};

/// A row of history.csv. Reactions are forces of the supports on the body, N per metre of
/// thickness.
struct StepRecord {
  int step = 0;
  double load_factor = 0.0;
  std::vector<std::array<double, 2>>
      reactions;               ///< one for every boundary block that prescribes a displacement
  double strain_energy = 0.0;  ///< J
  double crack_length = 0.0;   ///< m
  int active_tips = 0;
  int growth_cycles = 0;
  int solver_iterations = 0;
  double wall_s = 0.0;         ///< since the start of the run
  double external_work = 0.0;  ///< J, since the start of the run
  double dissipated = 0.0;     ///< J, external work that is not stored: friction and new cracks
  double friction_work = 0.0;  ///< J, the part that friction took
  int contact_iterations =
      0;  ///< most turns until touching faces settled, see Equilibrium; 0: none
  double contact_unbalanced = 0.0;  ///< worst of the step; see Equilibrium
};

/// A row of tips.csv, and a tip of summary.json.
struct TipRecord {
  int step = 0;
  int cycle = 0;
  int crack = 0;
  int end = 0;  ///< 0 start, 1 end of the crack
  Vec2 at{0, 0};
  std::string state = "active";     ///< "active", "boundary", "connected", "coalesced"
  int partner = -1;                 ///< crack that it met; -1 none
  double k1 = 0.0;                  ///< K_I, Pa m^1/2
  double k2 = 0.0;                  ///< K_II, Pa m^1/2
  std::string k_from = "integral";  ///< "integral", "fit"; empty for a tip that is not active
  double k_radius = 0.0;  ///< of the domain of the integral, m; 0 for a tip that is not active
  double u_tension = 0.0;
  double u_shear = 0.0;
  double angle_deg =
      0.0;  ///< direction of the next growth from the tip's tangent, counter-clockwise
  std::string mode = "none";
  double growth = 0.0;  ///< length of the increment, m
};

struct CrackRecord {
  std::string name;
  std::vector<Vec2> points;  ///< m
  double length = 0.0;       ///< m
};

struct EventRecord {
  int step = 0;
  int cycle = 0;
  std::string kind;  ///< "boundary", "connection", "coalescence", "fragment", "crossing", ...
  int crack = -1;
  int end = -1;
  int partner = -1;
  Vec2 at{0, 0};
};

/// The cracks as a network: connected groups, and whether one of them crosses the body.
struct NetworkRecord {
  int clusters = 0;
  double largest = 0.0;  ///< total crack length of the largest cluster, m
  bool spans_x = false;
  bool spans_y = false;
};

struct PerformanceRecord {
  double wall_s = 0.0;
  double setup_s = 0.0;
  double solve_s = 0.0;
  double output_s = 0.0;
  int linear_solves = 0;
  int solver_iterations = 0;                    ///< most in one linear solve
  std::vector<std::int64_t> peak_rss_bytes;     ///< per rank
  std::vector<std::int64_t> unknowns_per_rank;  ///< per rank
};

/// Everything in summary.json.
struct Summary {
  std::string version;
  std::string title;
  std::string status = "running";  ///< "completed", "separated", "failed", "running"
  std::string message;
  int ranks = 1;
  std::int64_t elements = 0;
  std::int64_t nodes = 0;
  std::int64_t unknowns = 0;
  double load_factor = 0.0;
  std::vector<std::string> reaction_names;  ///< of StepRecord::reactions, in order
  std::vector<StepRecord> steps;
  std::vector<TipRecord> tips;  ///< every end of every crack, at the last equilibrium
  std::vector<CrackRecord> cracks;
  NetworkRecord network;
  std::vector<EventRecord> events;
  PerformanceRecord performance;
};

}  // namespace cdca
