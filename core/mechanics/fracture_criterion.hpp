// SPDX-License-Identifier: BSD-3-Clause
/// When and in which direction a tip grows (section 3 of the paper).
#pragma once

#include "core/base/types.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace cdca {

/// Angle of the greatest hoop stress from the tip's tangent, rad, counter-clockwise; its sign is
/// opposite to K_II. Closed faces (K_I < 0) count as K_I = 0.
double hoop_angle(double k1, double k2);

/// K_eq = cos(t/2) (K_I cos^2(t/2) - 3/2 K_II sin t) at angle t: the mode-I intensity with the same
/// hoop stress.
double hoop_intensity(double k1, double k2, double angle);

/// How near to tensile failure a stress is: Griffith's parabola t^2 = 4 s_T (s_T - s_n) (Eq. 19) is
/// touched when the stress is multiplied by 1/U. Linear in the stress.
/// U = (s_n + sqrt(s_n^2 + t^2)) / (2 s_T); over all planes through a point this is Eq. 17-18.
double griffith_index(double normal, double shear, double tensile_strength);

/// Mohr-Coulomb (Eq. 20) on a plane under compression: (|t| + s_n tan(phi)) / c, tension positive;
/// 0 on planes in tension.
double coulomb_index(double normal, double shear, double cohesion, double friction_angle);

/// What the criterion knows of the material; Pa, Pa m^1/2, rad.
struct Strength {
  std::optional<double> tensile;
  std::optional<double> toughness;
  std::optional<double> cohesion;
  std::optional<double> friction_angle;

  /// (K_IC / s_T)^2 / 2 pi: where a mode-I field at its toughness has the tensile strength, m.
  std::optional<double> critical_distance() const;
};

enum class FractureMode : std::int32_t { none, tension, mixed, shear, hoop };
const char* name_of(FractureMode mode);

/// An index that has reached this counts as 1: tips that differ by less grow together, whatever the
/// rank count.
constexpr double growing_index = 1.0 - 1e-5;

/// The judgement of one tip. It grows when one of the indices reaches 1; tension has priority.
/// Indices may be multiplied with the load: what is asked of them follows.
struct TipJudgement {
  double u_tension = 0.0;
  double u_shear = 0.0;
  double tensile_angle = 0.0;                      ///< of the tensile growth, rad
  double shear_angle = 0.0;                        ///< of the growth in shear, rad
  FractureMode tensile_mode = FractureMode::none;  ///< of the tensile growth

  double index() const { return std::max(u_tension, u_shear); }
  bool grows() const { return index() >= growing_index; }
  bool in_shear() const { return grows() && u_tension < growing_index; }
  /// In which it grows, or would grow in tension, rad.
  double angle() const { return in_shear() ? shear_angle : tensile_angle; }
  FractureMode mode() const { return in_shear() ? FractureMode::shear : tensile_mode; }
};

/// Stresses on the arc round a tip, in polar components.
struct ArcSample {
  double angle = 0.0;   ///< rad, from the tangent
  double normal = 0.0;  ///< hoop stress, Pa
  double shear = 0.0;   ///< Pa
};

/// The near-tip field of K_I and K_II at distance r, |angle| <= 120 degrees; K_I < 0 counts as 0.
std::vector<ArcSample> singular_arc(double k1, double k2, double r);

/// Greatest hoop stress against the toughness.
TipJudgement judge_hoop(double k1, double k2, const Strength& strength);

/// Griffith's index on the arc, multiplied by `scale`; where it is greatest the angle is refined
/// between the samples. `full`: the whole field on the same arc, for the shear index; may be empty.
TipJudgement judge_mixed(const std::vector<ArcSample>& arc, const std::vector<ArcSample>& full,
                         double scale, const Strength& strength);

}  // namespace cdca
