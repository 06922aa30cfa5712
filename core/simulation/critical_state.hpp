// SPDX-License-Identifier: BSD-3-Clause
/// The equilibrium under which the next tip grows.
#pragma once

#include "core/simulation/growth.hpp"
#include "core/simulation/recorder.hpp"

namespace cdca {

/// An equilibrium at which the greatest index of all tips is 1, with the assessment of all tips.
struct CriticalState {
  Equilibrium equilibrium;
  std::vector<TipAssessment> tips;
  double factor = 1.0;
  bool grows = true;    ///< some tip is opened by the loads
  EnergyLedger energy;  ///< as of the last stop on the way: this equilibrium is still to be booked
};

/// Where the search begins: load factors of the last and of the first growth, 0 before any.
struct CriticalStart {
  double last_factor = 0.0;
  double first_factor = 0.0;
  const EnergyLedger& energy;
};

/// Without contact everything is proportional to the load factor, and one solve tells it. With
/// contact the load goes to it step by step from that of the last growth: slip, and the work that
/// it took, depend on the way. Long ways have stops, where what the faces have done becomes
/// history; the way to the first growth has them where faces have cohesion, and nothing is in
/// proportion to the loads.
CriticalState find_critical(Model& model, const EquilibriumSolver& solver,
                            const GrowthCriterion& criterion, const CriticalStart& start,
                            Recorder& recorder);

}  // namespace cdca
