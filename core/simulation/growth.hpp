// SPDX-License-Identifier: BSD-3-Clause
/// Which tips grow, where to and how far (section 3 of the paper).
#pragma once

#include "core/cracks/meetings.hpp"
#include "core/mechanics/fracture_criterion.hpp"
#include "core/mechanics/interaction_integral.hpp"
#include "core/simulation/equilibrium.hpp"

#include <optional>
#include <vector>

namespace cdca {

/// One active tip at one equilibrium.
struct TipAssessment {
  StressIntensity intensity;
  TipJudgement judgement;
};

/// Of all tips, in tension and shear; 0 where there is none.
double greatest_index(const std::vector<TipAssessment>& tips);

/// The fracture criterion of a case on its grid.
class GrowthCriterion {
 public:
  explicit GrowthCriterion(const Model& model);

  bool grows() const { return spec_.criterion != Criterion::none; }
  /// r0, m.
  double radius() const { return radius_; }
  /// Judges every active tip at the model's state. The same on all ranks. Collective.
  std::vector<TipAssessment> assess(const Model& model, double load_factor) const;
  /// Length of the increment of a tip with tensile index u, m.
  double step_length(const Model& model, double u) const;

 private:
  std::vector<ArcSample> full_arc(const Model& model, const StressIntensity& tip) const;

  const GrowthSpec& spec_;
  Strength strength_;
  double radius_ = 0.0;
  double scale_ = 1.0;  ///< of Griffith's index: sqrt(r0 / critical distance)
};

/// A tip that is to grow: the angle from its tangent, rad, and the length, m.
struct GrowthPlan {
  int crack = 0;
  int end = 0;
  double angle = 0.0;
  double length = 0.0;
  bool correct = false;  ///< its direction is to be corrected
  /// Of the trials so far: the last turn, rad, and K_II / K_I before it.
  double last_turn = 0.0;
  double last_mix = 0.0;
};

/// Plans for all tips that grow.
std::vector<GrowthPlan> plan_growth(const Model& model, const GrowthCriterion& criterion,
                                    const std::vector<TipAssessment>& tips);

/// Turns planned increments until they end with K_II near 0: all growing tips advance together on
/// trial, at most twice. when: they will grow. The model comes back with its own cracks and its own
/// state. Returns the equilibrium of the last trial, if there is one: that after growth is near it.
/// Collective.
std::optional<Model::CrackedField> correct_directions(Model& model, const EquilibriumSolver& solver,
                                                      double load_factor, const GrowthTime& when,
                                                      std::vector<GrowthPlan>& plans);

/// The increments of the plans for these cracks, ended where they meet something.
std::vector<Increment> increments_of(const Model& model, const CrackRegistry& registry,
                                     const std::vector<GrowthPlan>& plans);

}  // namespace cdca
