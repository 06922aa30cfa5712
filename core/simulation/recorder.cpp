// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/recorder.hpp"

#include "core/base/process_memory.hpp"
#include "core/simulation/drawing.hpp"

#include <algorithm>
#include <numbers>

namespace cdca {

namespace {

TipRecord record_of(const Crack& crack, int number, int end, int step) {
  TipRecord tip;
  tip.step = step;
  tip.crack = number;
  tip.end = end;
  tip.at = crack.end_point(end);
  tip.state = name_of(crack.ends[std::size_t(end)].state);
  tip.partner = crack.ends[std::size_t(end)].partner;
  tip.k_from = "";
  return tip;
}

void fill(TipRecord& tip, const TipAssessment& assessment) {
  const TipJudgement& j = assessment.judgement;
  tip.k1 = assessment.intensity.k1;
  tip.k2 = assessment.intensity.k2;
  tip.k_from = assessment.intensity.k1_fitted ? "fit" : "integral";
  tip.k_radius = assessment.intensity.radius;
  tip.u_tension = j.u_tension;
  tip.u_shear = j.u_shear;
  tip.angle_deg = j.angle() * 180 / std::numbers::pi;
  tip.mode = name_of(j.mode());
}

}  // namespace

Recorder::Recorder(const CaseSpec& spec, const std::string& version, Communicator& communicator,
                   std::span<Observer* const> observers)
    : spec_(spec), communicator_(communicator), observers_(observers) {
  summary_.version = version;
  summary_.title = spec.title;
  summary_.ranks = communicator.size();
  for (const BoundarySpec& b : spec.boundaries) {
    if (b.displacement[0] || b.displacement[1]) summary_.reaction_names.push_back(b.name);
  }
}

void Recorder::start(const Model& model, RunStory before) {
  started_ = true;
  summary_.steps = std::move(before.steps);
  summary_.tips = std::move(before.tips);
  summary_.performance = std::move(before.performance);
  if (!summary_.steps.empty()) summary_.load_factor = summary_.steps.back().load_factor;
  cycle_tips_ = std::move(before.cycle_tips);
  iterations_of_step_ = before.step_iterations;
  contact_iterations_of_step_ = before.step_contact_iterations;
  contact_unbalanced_of_step_ = before.step_contact_unbalanced;
  seconds_before_ = summary_.performance.wall_s;
  summary_.elements = model.grid().element_count();
  summary_.nodes = model.grid().node_count();
  summary_.unknowns = communicator_.sum(std::int64_t(model.unknowns().owned()));
  summary_.performance.setup_s += watch_.seconds();
  record_cracks(model);
  measure(model.unknowns().owned());
  for (Observer* o : observers_) o->on_start(summary_);
}

void Recorder::solved(const Equilibrium& equilibrium, double seconds) {
  const SolverReport& report = equilibrium.solver;
  auto& p = summary_.performance;
  p.solve_s += seconds;
  p.linear_solves += equilibrium.linear_solves;
  contact_iterations_of_step_ =
      std::max(contact_iterations_of_step_, equilibrium.contact_iterations);
  contact_unbalanced_of_step_ =
      std::max(contact_unbalanced_of_step_, equilibrium.contact_unbalanced);
  p.solver_iterations = std::max(p.solver_iterations, report.iterations);
  iterations_of_step_ = std::max(iterations_of_step_, report.iterations);
}

void Recorder::cycle(const Model& model, int step, int cycle,
                     const std::vector<TipAssessment>& tips,
                     const std::vector<Increment>& increments) {
  for (const TipAssessment& t : tips) {
    const StressIntensity& k = t.intensity;
    TipRecord tip =
        record_of(model.registry().cracks()[std::size_t(k.crack)], k.crack, k.end, step);
    tip.cycle = cycle;
    fill(tip, t);
    for (const Increment& i : increments) {
      if (i.crack == k.crack && i.end == k.end) tip.growth = i.length();
    }
    cycle_tips_.push_back(tip);
  }
}

void Recorder::step(const Model& model, const StepResult& result, const Equilibrium& equilibrium,
                    const EnergyLedger& energy, const std::vector<TipAssessment>& tips) {
  record_cracks(model);
  record_tips(model, result.step, tips);
  summary_.load_factor = result.load_factor;
  summary_.unknowns = communicator_.sum(std::int64_t(model.unknowns().owned()));
  summary_.steps.push_back(step_record(model, result, equilibrium, energy));
  if (result.last && summary_.status == "running") summary_.status = "completed";
  measure(model.unknowns().owned());
  const Stopwatch output;
  const StepView view{summary_, [&] { return draw_fields(model); },
                      [&] { return draw_cracks(model); }, cycle_tips_, result.last};
  for (Observer* o : observers_) o->on_step(view);
  summary_.performance.output_s += communicator_.max(output.seconds());
  cycle_tips_.clear();
  iterations_of_step_ = contact_iterations_of_step_ = 0;
  contact_unbalanced_of_step_ = 0.0;
}

bool Recorder::rest(const Model& model, const EnergyLedger& energy, const Progress& progress,
                    bool last) {
  const RestPoint point{
      progress,
      [&] {
        return take_checkpoint(
            model, energy, progress,
            {summary_.steps, summary_.tips, cycle_tips_, summary_.performance, iterations_of_step_,
             contact_iterations_of_step_, contact_unbalanced_of_step_});
      },
      last};
  const Stopwatch output;
  for (Observer* o : observers_) left_ = o->on_rest(point) || left_;
  summary_.performance.output_s += output.seconds();
  if (!left_) return false;
  record_cracks(model);
  const std::string where = point.ends_step() ? "after" : "in";
  set_status("running", "stopped " + where + " step " + std::to_string(point.step()) +
                            " as asked; --restart goes on from there.");
  return true;
}

void Recorder::set_status(const std::string& status, const std::string& message) {
  summary_.status = status;
  summary_.message = message;
}

void Recorder::finish() {
  measure(-1);
  if (summary_.status == "running" && !left_) summary_.status = "completed";
  for (Observer* o : observers_) o->on_finish(summary_);
}

void Recorder::fail(const std::string& message) {
  if (!started_) return;
  set_status("failed", message);
  for (Observer* o : observers_) o->on_finish(summary_);
}

StepRecord Recorder::step_record(const Model& model, const StepResult& result, const Equilibrium& e,
                                 const EnergyLedger& energy) const {
  StepRecord record;
  record.step = result.step;
  record.load_factor = result.load_factor;
  const double thickness = spec_.domain.thickness;
  for (std::size_t b = 0; b < spec_.boundaries.size(); ++b) {
    const BoundarySpec& block = spec_.boundaries[b];
    if (!block.displacement[0] && !block.displacement[1]) continue;
    const Vec2 r = thickness * e.reactions[b];
    record.reactions.push_back({r.x(), r.y()});
  }
  record.strain_energy = thickness * e.strain_energy;
  record.external_work = thickness * energy.external_work();
  record.dissipated = thickness * energy.dissipated();
  record.friction_work = thickness * energy.friction();
  record.contact_iterations = contact_iterations_of_step_;
  record.contact_unbalanced = contact_unbalanced_of_step_;
  record.crack_length = model.registry().length();
  record.active_tips = model.registry().active_tips();
  record.growth_cycles = result.growth_cycles;
  record.solver_iterations = iterations_of_step_;
  record.wall_s = seconds();
  return record;
}

void Recorder::record_cracks(const Model& model) {
  summary_.cracks.clear();
  for (const Crack& crack : model.registry().cracks()) {
    summary_.cracks.push_back({crack.name, crack.points, crack.length()});
  }
  const CrackNetwork n =
      network_of(model.registry().cracks(), model.body(), model.touch_distance());
  summary_.network = {n.clusters, n.largest, n.spans_x, n.spans_y};
  summary_.events.clear();
  for (const Event& e : model.registry().events()) {
    summary_.events.push_back({e.step, e.cycle, name_of(e.kind), e.crack, e.end, e.partner, e.at});
  }
}

void Recorder::record_tips(const Model& model, int step, const std::vector<TipAssessment>& tips) {
  summary_.tips.clear();
  const auto& cracks = model.registry().cracks();
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    for (int end = 0; end < 2; ++end) {
      TipRecord tip = record_of(cracks[c], int(c), end, step);
      for (const TipAssessment& t : tips) {
        if (t.intensity.crack == tip.crack && t.intensity.end == end) fill(tip, t);
      }
      summary_.tips.push_back(tip);
    }
  }
}

void Recorder::measure(LocalId owned) {
  const auto size = std::size_t(communicator_.size()), rank = std::size_t(communicator_.rank());
  auto& p = summary_.performance;
  p.peak_rss_bytes.assign(size, 0);
  p.peak_rss_bytes[rank] = peak_memory_bytes();
  communicator_.sum(std::span<std::int64_t>(p.peak_rss_bytes));
  if (owned >= 0) {
    p.unknowns_per_rank.assign(size, 0);
    p.unknowns_per_rank[rank] = owned;
    communicator_.sum(std::span<std::int64_t>(p.unknowns_per_rank));
  }
  p.wall_s = communicator_.max(seconds());
}

}  // namespace cdca
