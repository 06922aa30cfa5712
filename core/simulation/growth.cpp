// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/growth.hpp"

#include "core/base/errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cdca {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double sharp_turn = 30.0 / 180.0 * pi;
constexpr int most_trials = 2;

/// Noise below this cannot grow from cycle to cycle, nor differ between ranks.
double rounded(double value, double unit) { return std::round(value / unit) * unit; }

Vec2 turned(const Vec2& v, double angle) { return Eigen::Rotation2Dd(angle) * v; }

const Crack& crack_of(const CrackRegistry& registry, int crack) {
  return registry.cracks()[std::size_t(crack)];
}

bool has_grown(const Crack& crack, int end) {
  return (end == 0 ? crack.born.front() : crack.born.back()).step > 0;
}

/// By how much a direction is turned to end with K_II at 0. At first as for a kink: turning the
/// segment changes K_II at its end by about K_I / 2 a radian. Then by the secant: a wing that is
/// driven by a sliding flaw feels a turn up to four times as much.
double next_turn(GrowthPlan& plan, const StressIntensity& k) {
  const double mix = k.k2 / k.k1;
  double turn = hoop_angle(k.k1, k.k2);
  if (plan.last_turn != 0.0 && mix != plan.last_mix)
    turn = -mix * plan.last_turn / (mix - plan.last_mix);
  const double widest = 2 * std::abs(hoop_angle(k.k1, k.k2));
  plan.last_turn = rounded(std::clamp(turn, -widest, widest), 1e-6);
  plan.last_mix = mix;
  return plan.last_turn;
}

/// Turns the plans that are to be corrected, by K at their ends on trial. Does any still matter?
bool turn_plans(const Model& model, double load_factor, std::vector<GrowthPlan>& plans) {
  const auto is_corrected = [&](int crack, int end) {
    return std::any_of(plans.begin(), plans.end(), [&](const GrowthPlan& p) {
      return p.correct && p.crack == crack && p.end == end;
    });
  };
  bool turned_any = false;
  const auto intensities = model.stress_intensities(load_factor, is_corrected);
  for (GrowthPlan& plan : plans) {
    if (!plan.correct) continue;
    for (const StressIntensity& k : intensities) {
      if (k.crack != plan.crack || k.end != plan.end || k.k1 <= 0.0) continue;
      const double turn = next_turn(plan, k);
      if (std::abs(plan.angle + turn) > sharp_turn) {
        plan.last_turn = 0.0;  // not made: the next one learns nothing from it
        continue;
      }
      plan.angle += turn;
      turned_any = turned_any || std::abs(k.k2) > 0.01 * k.k1;
    }
  }
  return turned_any;
}

}  // namespace

double greatest_index(const std::vector<TipAssessment>& tips) {
  double u = 0.0;
  for (const TipAssessment& tip : tips) u = std::max(u, tip.judgement.index());
  return u;
}

GrowthCriterion::GrowthCriterion(const Model& model) : spec_(model.spec().growth) {
  const MaterialSpec& m = model.spec().material;
  strength_.tensile = m.tensile_strength;
  strength_.toughness = m.toughness;
  strength_.cohesion = m.cohesion;
  if (m.friction_angle) strength_.friction_angle = *m.friction_angle * pi / 180;
  const double h = model.grid().smallest_side();
  const auto critical = strength_.critical_distance();
  radius_ = spec_.radius > 0 ? spec_.radius : std::clamp(critical.value_or(3 * h), 2 * h, 4 * h);
  if (critical && !spec_.literal) scale_ = std::sqrt(radius_ / *critical);
}

std::vector<TipAssessment> GrowthCriterion::assess(const Model& model, double load_factor) const {
  const auto intensities = model.stress_intensities(load_factor);
  std::vector<TipAssessment> tips;
  for (const StressIntensity& k : intensities) {
    TipAssessment tip{k, {}};
    if (spec_.criterion == Criterion::hoop) tip.judgement = judge_hoop(k.k1, k.k2, strength_);
    if (spec_.criterion == Criterion::mixed) {
      const auto full = full_arc(model, k);
      tip.judgement = judge_mixed(spec_.full_field ? full : singular_arc(k.k1, k.k2, radius_), full,
                                  scale_, strength_);
    }
    tips.push_back(tip);
  }
  return tips;
}

std::vector<ArcSample> GrowthCriterion::full_arc(const Model& model,
                                                 const StressIntensity& k) const {
  constexpr int directions = 49;
  const Crack& crack = crack_of(model.registry(), k.crack);
  const Vec2 tip = crack.end_point(k.end), tangent = crack.end_tangent(k.end);
  // normal, shear and number of samples of every direction, added up over the ranks
  std::vector<double> sums(3 * directions, 0.0);
  std::vector<double> angles;
  for (int d = 0; d < directions; ++d) {
    angles.push_back(-2 * pi / 3 + 4 * pi / 3 * d / (directions - 1));
    const Vec2 radial = turned(tangent, angles.back()), hoop = turned_left(radial);
    // a mean over a few radii and angles smooths the jumps between elements
    for (const double r : {0.85, 1.0, 1.15}) {
      for (const double turn : {-0.06, 0.0, 0.06}) {
        const Vec2 x = tip + radius_ * r * turned(radial, turn);
        const auto stress = model.visible_stress(tip + 1e-6 * radius_ * tangent, x);
        if (!stress) continue;
        Eigen::Matrix2d s;
        s << (*stress)[0], (*stress)[2], (*stress)[2], (*stress)[1];
        const auto at = std::size_t(3 * d);
        sums[at] += hoop.dot(s * hoop);
        sums[at + 1] += radial.dot(s * hoop);
        sums[at + 2] += 1.0;
      }
    }
  }
  model.communicator().sum(std::span<double>(sums));
  std::vector<ArcSample> arc;
  for (std::size_t d = 0; d < angles.size(); ++d) {
    const double count = sums[3 * d + 2];
    if (count > 0) arc.push_back({angles[d], sums[3 * d] / count, sums[3 * d + 1] / count});
  }
  return arc;
}

double GrowthCriterion::step_length(const Model& model, double u) const {
  const double unit = spec_.step_in_metres ? 1.0 : model.grid().smallest_side();
  const double low = spec_.step_length[0] * unit, high = spec_.step_length[1] * unit;
  if (spec_.fixed_step) return low;
  // the singular stress ahead falls as 1 / sqrt(r): it breaks the material up to u^2 r
  const double reach = strength_.critical_distance().value_or(radius_) * u * u;
  return std::clamp(reach, low, high);
}

std::vector<GrowthPlan> plan_growth(const Model& model, const GrowthCriterion& criterion,
                                    const std::vector<TipAssessment>& tips) {
  const double h = model.grid().smallest_side();
  std::vector<GrowthPlan> plans;
  for (const TipAssessment& tip : tips) {
    const TipJudgement& j = tip.judgement;
    if (!j.grows()) continue;
    GrowthPlan plan{tip.intensity.crack, tip.intensity.end, j.angle(),
                    criterion.step_length(model, std::max(1.0, j.u_tension / growing_index)),
                    false};
    plan.angle = rounded(plan.angle, 1e-6);
    plan.length = rounded(plan.length, 1e-6 * h);
    plan.correct = model.spec().growth.corrected && !j.in_shear() &&
                   has_grown(crack_of(model.registry(), plan.crack), plan.end) &&
                   std::abs(plan.angle) <= sharp_turn;
    plans.push_back(plan);
  }
  return plans;
}

std::vector<Increment> increments_of(const Model& model, const CrackRegistry& registry,
                                     const std::vector<GrowthPlan>& plans) {
  std::vector<Increment> increments;
  for (const GrowthPlan& plan : plans) {
    const Crack& crack = crack_of(registry, plan.crack);
    const Vec2 from = crack.end_point(plan.end);
    increments.push_back({plan.crack, plan.end, from,
                          from + plan.length * turned(crack.end_tangent(plan.end), plan.angle)});
  }
  return resolve_meetings(registry, model.body(), model.touch_distance(), std::move(increments));
}

std::optional<Model::CrackedField> correct_directions(Model& model, const EquilibriumSolver& solver,
                                                      double load_factor, const GrowthTime& when,
                                                      std::vector<GrowthPlan>& plans) {
  const bool any =
      std::any_of(plans.begin(), plans.end(), [](const GrowthPlan& p) { return p.correct; });
  if (!any) return std::nullopt;
  const CrackRegistry registry = model.registry();
  const bool joined = model.joins_loaded_boundaries();
  const Model::ContactMemory memory = model.contact_memory();
  const std::vector<double> state = model.state();
  std::optional<Model::CrackedField> found;
  bool turned_any = true;
  // a trial begins where the one before it has come to rest
  for (int trial = 0; trial < most_trials && turned_any; ++trial) {
    CrackRegistry ahead = registry;
    apply_increments(increments_of(model, registry, plans), model.touch_distance(), when, ahead);
    model.lay_cracks(ahead);
    // where the step cuts the body apart there is no field to correct it by
    if (joined && !model.joins_loaded_boundaries()) break;
    try {
      find_equilibrium(model, solver, load_factor, FaceMotion::balanced);
    } catch (const ContactError&) {
      break;
    }
    found = model.cracked_field();
    turned_any = turn_plans(model, load_factor, plans);
  }
  model.remember(memory);
  model.lay_cracks(registry, Model::OpenFaces::are_open);
  model.state() = state;
  return found;
}

}  // namespace cdca
