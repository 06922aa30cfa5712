// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/critical_state.hpp"

#include "core/base/errors.hpp"
#include "core/simulation/critical_factor.hpp"
#include "core/simulation/recorded_solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace cdca {

namespace {

/// Steps of the load longer than this part of it begin at a stop.
constexpr double long_way = 0.1;
/// Index of loads under which a part slides off: if anything grows before, it is at less load.
constexpr double sliding_off = 2.0;

/// An equilibrium found at factor 1, at another factor.
void scale(Model& model, Equilibrium& equilibrium, std::vector<TipAssessment>& tips,
           double factor) {
  for (double& u : model.state()) u *= factor;
  for (double& f : equilibrium.external) f *= factor;
  for (double& f : equilibrium.supports) f *= factor;
  for (Vec2& r : equilibrium.reactions) r *= factor;
  equilibrium.strain_energy *= factor * factor;
  for (TipAssessment& tip : tips) {
    tip.intensity.k1 *= factor;
    tip.intensity.k2 *= factor;
    tip.judgement.u_tension *= factor;
    tip.judgement.u_shear *= factor;
  }
}

CriticalState scaled_to_critical(Model& model, const EquilibriumSolver& solver,
                                 const GrowthCriterion& criterion, const CriticalStart& start,
                                 Recorder& recorder) {
  CriticalState found{solve_recorded(model, solver, 1.0, recorder), {}, 1.0, true, start.energy};
  found.tips = criterion.assess(model, 1.0);
  const double u = greatest_index(found.tips);
  found.grows = u > 0.0;
  if (found.grows) found.factor = 1.0 / u;
  scale(model, found.equilibrium, found.tips, found.factor);
  return found;
}

/// The place from which the search tries loads: what is behind it has become history.
class Stop {
 public:
  Stop(Model& model, const CriticalStart& start)
      : model_(model),
        start_factor_(start.last_factor),
        factor_(start.last_factor),
        energy_(start.energy),
        contact_(model.contact_memory()),
        state_(model.state()) {}

  /// The model is at an equilibrium that the body passes through: from here on.
  void move_to(const Equilibrium& here, double factor) {
    energy_.new_factor(model_, here, factor);
    const bool loads_at_rest = factor == start_factor_ && factor_ == start_factor_;
    accept_contact(model_, loads_at_rest ? Model::Since::other_cracks : Model::Since::other_loads,
                   energy_);
    factor_ = factor;
    contact_ = model_.contact_memory();
    state_ = model_.state();
  }

  /// Faces are what they were here. Displacements are in proportion between those here and of the
  /// trial, at the factor that it had: a loose body stays where it is at the start.
  void go_back(double tried, double next) {
    const double way = tried - factor_;
    const double share = way == 0.0 ? 1.0 : std::clamp((next - factor_) / way, 0.0, 1.0);
    std::vector<double>& start = model_.state();
    for (std::size_t k = 0; k < start.size(); ++k)
      start[k] = state_[k] + share * (start[k] - state_[k]);
    model_.remember(contact_);
    model_.set_origin(state_);
    model_.renew_stiffness();
  }
  const EnergyLedger& energy() const { return energy_; }

 private:
  Model& model_;
  double start_factor_;
  double factor_;
  EnergyLedger energy_;
  Model::ContactMemory contact_;
  std::vector<double> state_;  ///< displacements
};

/// Whether displacements are in proportion to loads until something grows. Faces that hold to each
/// other without pressure bear a part of loads under which they would slide or part.
bool is_proportional(const Model& model) {
  const auto& cracks = model.spec().cracks;
  return std::none_of(cracks.begin(), cracks.end(), [](const CrackSpec& crack) {
    return crack.contact.law == ContactLaw::cohesive || crack.contact.cohesion > 0.0;
  });
}

CriticalState searched_to_critical(Model& model, const EquilibriumSolver& solver,
                                   const GrowthCriterion& criterion, const CriticalStart& start,
                                   Recorder& recorder) {
  constexpr int most = 100;
  const Stop first(model, start);
  std::optional<Stop> stop(first);
  CriticalFactor search(start.last_factor, start.first_factor);
  CriticalState found;
  for (int round = 0; round < most && !search.ended(); ++round) {
    const double next = search.next();
    const bool far = std::abs(next - found.factor) > long_way * found.factor;
    if (search.back_at_start()) {
      stop.emplace(first);
    } else if (round > 0 && search.on_the_way() && far) {
      stop->move_to(found.equilibrium, found.factor);
    }
    if (round > 0) stop->go_back(found.factor, next);
    found.factor = next;
    try {
      found.equilibrium = solve_recorded(model, solver, next, recorder);
      found.tips = criterion.assess(model, next);
      search.tell(greatest_index(found.tips));
    } catch (const SlidesOff&) {
      if (!search.goes_beyond() && (start.last_factor > 0.0 || is_proportional(model))) throw;
      search.tell(sliding_off);
    }
  }
  if (!search.ended()) {
    throw ContactError(
        "the load factor at which the next tip grows was not found; the states of "
        "touching faces change with it.");
  }
  found.grows = search.grows();
  found.energy = stop->energy();
  return found;
}

/// The same, once a first search has told about where it is: on the way there by steps, since what
/// friction and tearing take depends on the way.
CriticalState walked_to_critical(Model& model, const EquilibriumSolver& solver,
                                 const GrowthCriterion& criterion, Stop stop, double factor,
                                 Recorder& recorder) {
  constexpr int steps = 40;
  stop.go_back(factor, factor / steps);
  double last = 0.0;
  for (int k = 1; k < steps; ++k) {
    last = factor * k / steps;
    stop.move_to(solve_recorded(model, solver, last, recorder), last);
  }
  return searched_to_critical(model, solver, criterion, {last, last, stop.energy()}, recorder);
}

}  // namespace

CriticalState find_critical(Model& model, const EquilibriumSolver& solver,
                            const GrowthCriterion& criterion, const CriticalStart& start,
                            Recorder& recorder) {
  if (model.contact().empty()) return scaled_to_critical(model, solver, criterion, start, recorder);
  const Stop first(model, start);
  const CriticalState found = searched_to_critical(model, solver, criterion, start, recorder);
  if (start.last_factor > 0.0 || !found.grows || is_proportional(model)) return found;
  return walked_to_critical(model, solver, criterion, first, found.factor, recorder);
}

}  // namespace cdca
