// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/load_stepper.hpp"

#include "core/base/errors.hpp"
#include "core/simulation/critical_state.hpp"
#include "core/simulation/recorded_solve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace cdca {

namespace {

constexpr int most_halvings = 3;  ///< of a load step whose contact does not settle

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

/// Equilibrium at load factor `to`; where touching faces do not settle, by way of the middle, and
/// so on, at most `halvings` times, and then by creeping there under the new loads.
Equilibrium reach(Model& model, const EquilibriumSolver& solver, double from, double to,
                  int halvings, Recorder& recorder, EnergyLedger& energy) {
  const Model::ContactMemory memory = model.contact_memory();
  const std::vector<double> state = model.state();
  const FaceMotion faces = halvings == 0 ? FaceMotion::creeping : FaceMotion::balanced;
  try {
    const Equilibrium equilibrium = solve_recorded(model, solver, to, recorder, faces);
    energy.new_loads(model, equilibrium);
    accept_contact(model, Model::Since::other_loads, energy);
    return equilibrium;
  } catch (const ContactError&) {
    if (halvings == 0) throw;
  }
  model.remember(memory);
  model.state() = state;
  model.renew_stiffness();
  const double middle = 0.5 * (from + to);
  reach(model, solver, from, middle, halvings - 1, recorder, energy);
  return reach(model, solver, middle, to, halvings - 1, recorder, energy);
}

void advance(Model& model, const std::vector<Increment>& increments, const GrowthTime& when) {
  CrackRegistry registry = model.registry();
  apply_increments(increments, model.touch_distance(), when, registry);
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

struct NextGrowth {
  std::vector<Increment> increments;
  std::optional<Model::CrackedField> trial;  ///< equilibrium of nearly the same cracks
};

NextGrowth next_growth(Model& model, const EquilibriumSolver& solver, double factor,
                       const GrowthCriterion& criterion, const std::vector<TipAssessment>& tips,
                       const GrowthTime& when) {
  auto plans = plan_growth(model, criterion, tips);
  auto trial = correct_directions(model, solver, factor, when, plans);
  return {increments_of(model, model.registry(), plans), std::move(trial)};
}

/// Equilibrium of cracks that have grown: where there was a trial, from there; otherwise, and where
/// faces do not settle from there, from where they were before.
Equilibrium solve_grown(Model& model, const EquilibriumSolver& solver, double factor,
                        const NextGrowth& growth, Recorder& recorder) {
  if (growth.trial) {
    const Model::ContactMemory memory = model.contact_memory();
    const std::vector<double> state = model.state();
    model.start_from(*growth.trial);
    try {
      return solve_recorded(model, solver, factor, recorder, FaceMotion::balanced);
    } catch (const ContactError&) {
    }
    model.remember(memory);
    model.state() = state;
    model.renew_stiffness();
  }
  return solve_recorded(model, solver, factor, recorder);
}

/// Why a run ends as separated.
struct Separation {
  bool is_there = false;
  std::string why = "growth has cut the body apart between its loaded boundaries.";

  /// The equilibrium that `find` returns; nothing, and a separation, where a part slides off.
  template <class Find>
  auto unless_it_slides_off(const Find& find) -> decltype(find()) {
    try {
      return find();
    } catch (const SlidesOff& error) {
      is_there = true;
      why = error.what();
      return {};
    }
  }
};

/// The first load step that is left to be done: the case may have other steps now than it had.
std::size_t next_step(const std::vector<double>& factors, const Progress& at) {
  if (at.steps == 0 && at.cycles == 0) return 0;
  double margin = 0.0;
  for (const double f : factors) margin = std::max(margin, 1e-9 * std::abs(f));
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
    compare_registries(model);
    Separation separation;
    Equilibrium equilibrium = separation.unless_it_slides_off([&] {
      return reach(model, *solver, at.load_factor, result.load_factor, most_halvings, recorder,
                   energy);
    });
    at.load_factor = result.load_factor;
    note_fragments(model, result.step, 0);
    bool& separated = separation.is_there;
    // parts that loads alone have moved apart are not separated by growth
    at.joined = model.joins_loaded_boundaries();
    std::vector<TipAssessment> tips;
    if (!separated) tips = criterion.assess(model, result.load_factor);
    for (int& cycle = result.growth_cycles; criterion.grows() && !separated;) {
      if (greatest_index(tips) < growing_index) break;
      if (cycle >= spec.growth.cycles) {  // a run that goes on may be allowed fewer
        note(model, EventKind::unstable, result.step, cycle);
        break;
      }
      const GrowthTime when{result.step, cycle + 1};
      const NextGrowth growth =
          next_growth(model, *solver, result.load_factor, criterion, tips, when);
      recorder.cycle(model, result.step, cycle, tips, growth.increments);
      advance(model, growth.increments, when);
      ++cycle;
      separated = at.joined && !model.joins_loaded_boundaries();
      if (!separated) {
        equilibrium = separation.unless_it_slides_off(
            [&] { return solve_grown(model, *solver, result.load_factor, growth, recorder); });
        // faces that might have held the parts together may have opened
        separated = separated || (at.joined && !model.joins_loaded_boundaries());
      }
      note_fragments(model, result.step, cycle);
      if (separated) break;
      energy.new_cracks(model, equilibrium);
      accept_contact(model, Model::Since::other_cracks, energy);
      tips = criterion.assess(model, result.load_factor);
      at.cycles = cycle;
      if (recorder.rest(model, energy, at)) return;
    }
    if (separated) {
      equilibrium = unloaded(model);
      energy.broken();
      tips.clear();
      result.last = true;
    }
    recorder.cycle(model, result.step, result.growth_cycles, tips, {});
    if (separated) {
      note(model, EventKind::separated, result.step, result.growth_cycles);
      recorder.set_status("separated", separation.why);
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
  energy.let_cracks_grow();  // as they had where a run goes on
  for (int event = at.steps + 1;; ++event) {
    compare_registries(model);
    Separation separation{at.joined && !model.joins_loaded_boundaries()};
    bool& separated = separation.is_there;
    CriticalState now;
    if (!separated) {
      now = separation.unless_it_slides_off([&] {
        return find_critical(model, *solver, criterion, {at.load_factor, at.first_factor, energy},
                             recorder);
      });
      separated = separated || (at.joined && !model.joins_loaded_boundaries());
    }
    note_fragments(model, event, 0);
    if (separated) {
      const Equilibrium nothing = unloaded(model);
      energy.broken();
      note(model, EventKind::separated, event, 0);
      recorder.set_status("separated", separation.why);
      recorder.step(model, {event, 0.0, 0, true}, nothing, energy, {});
      return;
    }
    if (!now.grows)
      recorder.set_status("completed", "no load of this kind opens a tip: nothing grows any more.");
    const double factor = now.factor;
    if (now.grows) largest = std::max(largest, factor);
    if (now.grows && at.first_factor == 0.0) at.first_factor = factor;
    StepResult result{event, factor, 1, false};
    result.last = !now.grows || event >= spec.loading.max_events ||
                  factor < spec.loading.min_factor * largest;
    energy = std::move(now.energy);
    energy.new_factor(model, now.equilibrium, factor);
    accept_contact(model, Model::Since::other_loads, energy);
    NextGrowth growth;
    const GrowthTime when{event, 1};
    if (!result.last) growth = next_growth(model, *solver, factor, criterion, now.tips, when);
    recorder.cycle(model, event, 0, now.tips, growth.increments);
    recorder.step(model, result, now.equilibrium, energy, now.tips);
    if (result.last) return;
    energy.let_cracks_grow();
    advance(model, growth.increments, when);
    if (growth.trial) model.start_from(*growth.trial);
    if (model.contact().empty()) {
      for (double& v : model.state()) v /= factor;  // the next solve starts at factor 1
    }
    at.steps = event;
    at.load_factor = factor;
    if (recorder.rest(model, energy, at)) return;
  }
}

}  // namespace cdca
