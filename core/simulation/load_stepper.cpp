// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/load_stepper.hpp"

#include "core/base/errors.hpp"

#include <algorithm>
#include <array>

namespace cdca {

namespace {

/// Tips whose index differs by less than this grow together, whatever the rank count.
constexpr double equal_index = 1e-6;
const char* const cut_apart = "growth has cut the body apart between its loaded boundaries.";

/// A difference between the copies of the registry is a bug that would spoil all that follows.
void compare_registries(const Model& model) {
  const std::uint64_t hash = model.registry().hash();
  const std::array<double, 2> halves{double(hash >> 32), double(hash & 0xffffffffU)};
  std::array<double, 2> low = halves, high = halves;
  model.communicator().min(std::span<double>(low));
  model.communicator().max(std::span<double>(high));
  if (low != high) {
    throw SolveError("the crack registries of the ranks differ; this is an error in the program.");
  }
}

Equilibrium solve(Model& model, const EquilibriumSolver& solver, double factor,
                  Recorder& recorder) {
  const Stopwatch watch;
  Equilibrium equilibrium = find_equilibrium(model, solver, factor);
  recorder.solved(equilibrium.solver, watch.seconds());
  return equilibrium;
}

double greatest_index(const std::vector<TipAssessment>& tips) {
  double u = 0.0;
  for (const TipAssessment& tip : tips) {
    u = std::max({u, tip.judgement.u_tension, tip.judgement.u_shear});
  }
  return u;
}

void advance(Model& model, const std::vector<Increment>& increments, int step, int cycle) {
  CrackRegistry registry = model.registry();
  apply_increments(increments, model.touch_distance(), step, cycle, registry);
  model.lay_cracks(std::move(registry));
}

/// Writes down the bodies that have come loose: those in which no fragment has been noted yet.
void note_fragments(Model& model, int step, int cycle) {
  const auto loose = model.loose_bodies();
  if (loose.empty()) return;
  CrackRegistry registry = model.registry();
  std::vector<Vec2> noted;
  for (const Event& e : registry.events()) {
    if (e.kind == EventKind::fragment) noted.push_back(e.at);
  }
  const auto known = model.bodies_at(noted);
  for (const std::size_t body : loose) {
    if (std::find(known.begin(), known.end(), body) != known.end()) continue;
    const Vec2 at = model.bodies().list()[body].at;
    registry.record({step, cycle, EventKind::fragment, -1, -1, -1, at});
  }
  model.replace_events(std::move(registry));
}

void note(Model& model, EventKind kind, int step, int cycle) {
  CrackRegistry registry = model.registry();
  registry.record({step, cycle, kind, -1, -1, -1, Vec2(0, 0)});
  model.replace_events(registry);
}

std::vector<Increment> next_increments(Model& model, const EquilibriumSolver& solver, double factor,
                                       const GrowthCriterion& criterion,
                                       const std::vector<TipAssessment>& tips, double threshold) {
  auto plans = plan_growth(model, criterion, tips, threshold);
  correct_directions(model, solver, factor, plans);
  return increments_of(model, plans);
}

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

/// The first load step that is left to be done: the case may have other steps now than it had.
std::size_t next_step(const std::vector<double>& factors, const Progress& at) {
  if (at.steps == 0 && at.cycles == 0) return 0;
  const double margin = 1e-9 * at.load_factor;
  const double from = at.cycles > 0 ? at.load_factor - margin : at.load_factor + margin;
  return std::size_t(std::lower_bound(factors.begin(), factors.end(), from) - factors.begin());
}

}  // namespace

void run_prescribed(Model& model, Recorder& recorder, RunStart start) {
  const CaseSpec& spec = model.spec();
  const auto solver = make_solver(model);
  const GrowthCriterion criterion(model);
  auto& [at, energy] = start;
  for (std::size_t k = next_step(spec.load_factors, at); k < spec.load_factors.size(); ++k) {
    StepResult result{at.steps + 1, spec.load_factors[k], at.cycles,
                      k + 1 == spec.load_factors.size()};
    at.load_factor = result.load_factor;
    compare_registries(model);
    Equilibrium equilibrium = solve(model, *solver, result.load_factor, recorder);
    note_fragments(model, result.step, 0);
    energy.new_loads(model, equilibrium);
    auto tips = criterion.assess(model, result.load_factor);
    bool separated = false;
    for (int& cycle = result.growth_cycles; criterion.grows() && !separated;) {
      if (greatest_index(tips) < 1.0 - equal_index) break;
      if (cycle == spec.growth.cycles) {
        note(model, EventKind::unstable, result.step, cycle);
        break;
      }
      const auto increments =
          next_increments(model, *solver, result.load_factor, criterion, tips, 1.0 - equal_index);
      recorder.cycle(model, result.step, cycle, tips, increments);
      advance(model, increments, result.step, ++cycle);
      separated = at.joined && !model.joins_loaded_boundaries();
      if (separated) {
        note_fragments(model, result.step, cycle);
        equilibrium = unloaded(model);
        energy.broken();
        tips.clear();
        break;
      }
      equilibrium = solve(model, *solver, result.load_factor, recorder);
      note_fragments(model, result.step, cycle);
      energy.new_cracks(model, equilibrium);
      tips = criterion.assess(model, result.load_factor);
      at.cycles = cycle;
      if (recorder.rest(model, energy, at)) return;
    }
    recorder.cycle(model, result.step, result.growth_cycles, tips, {});
    if (separated) {
      note(model, EventKind::separated, result.step, result.growth_cycles);
      recorder.set_status("separated", cut_apart);
      result.last = true;
    }
    recorder.step(model, result, equilibrium, energy, tips);
    if (separated) return;
    at.steps = result.step;
    at.cycles = 0;
    if (recorder.rest(model, energy, at, result.last)) return;
  }
}

void run_critical(Model& model, Recorder& recorder, RunStart start) {
  const CaseSpec& spec = model.spec();
  const auto solver = make_solver(model);
  const GrowthCriterion criterion(model);
  auto& [at, energy] = start;
  double& largest = at.largest_factor;
  for (int event = at.steps + 1;; ++event) {
    compare_registries(model);
    if (at.joined && !model.joins_loaded_boundaries()) {
      const Equilibrium nothing = unloaded(model);
      energy.broken();
      note_fragments(model, event, 0);
      note(model, EventKind::separated, event, 0);
      recorder.set_status("separated", cut_apart);
      recorder.step(model, {event, 0.0, 0, true}, nothing, energy, {});
      return;
    }
    Equilibrium equilibrium = solve(model, *solver, 1.0, recorder);
    note_fragments(model, event, 0);
    auto tips = criterion.assess(model, 1.0);
    const double u = greatest_index(tips);
    if (u <= 0.0) recorder.set_status("completed", "no tip is opened by the loads: nothing grows.");
    // everything is proportional: the first tip reaches 1 at this factor
    const double factor = u > 0.0 ? 1.0 / u : 1.0;
    if (u > 0.0) largest = std::max(largest, factor);
    StepResult result{event, factor, 1, false};
    result.last =
        u <= 0.0 || event == spec.loading.max_events || factor < spec.loading.min_factor * largest;
    scale(model, equilibrium, tips, factor);
    energy.new_cracks_and_factor(model, equilibrium, factor);
    if (result.last) {
      recorder.cycle(model, event, 0, tips, {});
      recorder.step(model, result, equilibrium, energy, tips);
      return;
    }
    const auto increments =
        next_increments(model, *solver, factor, criterion, tips, 1.0 - equal_index);
    recorder.cycle(model, event, 0, tips, increments);
    recorder.step(model, result, equilibrium, energy, tips);
    advance(model, increments, event, 1);
    for (double& v : model.state()) v /= factor;  // the next solve starts at factor 1
    at.steps = event;
    at.load_factor = factor;
    if (recorder.rest(model, energy, at)) return;
  }
}

}  // namespace cdca
