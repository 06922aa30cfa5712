// SPDX-License-Identifier: BSD-3-Clause
/// The cases of tests/verification/reference/: geometry, loads, reference values and tolerances.
#pragma once

#include "core/base/types.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cdca::testing {

struct ReferenceCase {
  std::string id;
  std::string tag;
  nlohmann::json json;
};

/// Says which case a test runs, and gives it its name.
void PrintTo(const ReferenceCase& reference, std::ostream* out);
std::string test_name(const ReferenceCase& reference);

/// All cases of cases.json and then all paths of paths.json (whose group is "paths"), in their
/// order.
std::vector<ReferenceCase> reference_cases();
/// How many of them carry each tag.
std::map<std::string, int> reference_tags();

/// Cracks in a rectangle or in an infinite plane. Lengths in the unit of the case.
struct ReferenceGeometry {
  struct CrackLine {
    std::vector<Vec2> points;
    bool is_tip[2] = {true, true};  ///< does its first, last point end in the material?
  };
  bool infinite = false;
  Vec2 lower{0, 0};  ///< of the rectangle
  Vec2 upper{0, 0};
  std::vector<CrackLine> cracks;
  bool smooth = false;  ///< polylines stand for a curve: their bends are no features

  /// Half the length of a crack with two tips, the length of one with one; of the shortest one.
  double shortest() const;
  /// The same of the longest one.
  double longest() const;
  /// The shortest way from a tip to a bend behind it, to another crack or to the rim.
  double room() const;
};
ReferenceGeometry geometry_of(const ReferenceCase& reference);

struct ReferenceLoad {
  enum class Kind { stress, slope, bending, edge_shear };
  Kind kind = Kind::stress;
  Voigt stress{0, 0, 0};             ///< on the rim, or far away
  double slope = 0.0;                ///< sigma_yy = slope x on the rim, or far away
  std::optional<double> friction{};  ///< of faces that touch; without it they do not
};
ReferenceLoad load_of(const ReferenceCase& reference);

/// What a tip of the case must show, in axes with x out of the crack.
struct ExpectedTip {
  Vec2 at{0, 0};
  double k1 = 0.0;
  double k2 = 0.0;
  bool sign_of_k2 = true;  ///< false: the size of K_II counts only
};
std::vector<ExpectedTip> expected_tips(const ReferenceCase& reference);

/// Stresses at a place seen from the tip, in axes with x out of the crack.
struct ExpectedStress {
  double r = 0.0;
  double degrees = 0.0;
  Voigt stress{0, 0, 0};
  int components = 3;  ///< how many of xx, yy, xy are given
};
std::vector<ExpectedStress> expected_stresses(const ReferenceCase& reference);

/// The tolerances that a case may name.
struct ReferenceTolerance {
  std::optional<double> k_rel, k2_over_max, k_over_max, k_rel_of_max, stress_rel;
  std::optional<double> k2_rel, k1_over_k2;          ///< of closed cracks
  std::optional<double> closure_elements;            ///< of the place where a crack closes
  std::optional<double> initiation_rel, arrest_rel;  ///< of stresses and lengths
};
ReferenceTolerance tolerance_of(const ReferenceCase& reference);

}  // namespace cdca::testing
