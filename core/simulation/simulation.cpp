// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/simulation.hpp"

#include "core/base/errors.hpp"
#include "core/base/process_memory.hpp"
#include "core/base/stopwatch.hpp"
#include "core/mechanics/interaction_integral.hpp"
#include "core/simulation/drawing.hpp"
#include "core/simulation/equilibrium.hpp"

#include <algorithm>

namespace cdca {

namespace {

/// Builds the summary as the run goes on and shows it to the observers.
class Recorder {
 public:
  Recorder(const CaseSpec& spec, const std::string& version, Communicator& communicator,
           std::span<Observer* const> observers)
      : spec_(spec), communicator_(communicator), observers_(observers) {
    summary_.version = version;
    summary_.title = spec.title;
    summary_.ranks = communicator.size();
    for (const BoundarySpec& b : spec.boundaries) {
      if (b.displacement[0] || b.displacement[1]) summary_.reaction_names.push_back(b.name);
    }
  }

  const Summary& summary() const { return summary_; }

  void start(const Model& model) {
    started_ = true;
    summary_.elements = model.grid().element_count();
    summary_.nodes = model.grid().node_count();
    summary_.unknowns = communicator_.sum(std::int64_t(model.unknowns().owned()));
    summary_.performance.setup_s = watch_.seconds();
    record_cracks(model);
    measure(model.unknowns().owned());
    for (Observer* o : observers_) o->on_start(summary_);
  }

  void step(const Model& model, int step, double factor, const Equilibrium& equilibrium,
            double solve_seconds, const std::vector<StressIntensity>& intensities, bool last) {
    summary_.performance.solve_s += solve_seconds;
    summary_.performance.linear_solves += 1;
    summary_.performance.solver_iterations =
        std::max(summary_.performance.solver_iterations, equilibrium.solver.iterations);
    record_cracks(model);
    const auto tips = record_tips(model, step, intensities);
    summary_.load_factor = factor;
    summary_.steps.push_back(step_record(model, step, factor, equilibrium));
    if (last) summary_.status = "completed";
    measure(model.unknowns().owned());
    const Stopwatch output;
    const StepView view{summary_, [&] { return draw_fields(model); },
                        [&] { return draw_cracks(model); }, tips, last};
    for (Observer* o : observers_) o->on_step(view);
    summary_.performance.output_s += communicator_.max(output.seconds());
  }

  void finish() {
    measure(-1);
    for (Observer* o : observers_) o->on_finish(summary_);
  }

  void fail(const std::string& message) {
    if (!started_) return;
    summary_.status = "failed";
    summary_.message = message;
    for (Observer* o : observers_) o->on_finish(summary_);
  }

 private:
  StepRecord step_record(const Model& model, int step, double factor, const Equilibrium& e) const {
    StepRecord record;
    record.step = step;
    record.load_factor = factor;
    for (std::size_t b = 0; b < spec_.boundaries.size(); ++b) {
      const BoundarySpec& block = spec_.boundaries[b];
      if (!block.displacement[0] && !block.displacement[1]) continue;
      const Vec2 r = spec_.domain.thickness * e.reactions[b];
      record.reactions.push_back({r.x(), r.y()});
    }
    record.strain_energy = spec_.domain.thickness * e.strain_energy;
    record.crack_length = model.registry().length();
    record.active_tips = model.registry().active_tips();
    record.solver_iterations = e.solver.iterations;
    record.wall_s = watch_.seconds();
    return record;
  }

  void record_cracks(const Model& model) {
    summary_.cracks.clear();
    for (const Crack& crack : model.registry().cracks()) {
      summary_.cracks.push_back({crack.name, crack.points, crack.length()});
    }
    const CrackNetwork n =
        network_of(model.registry().cracks(), model.body(), model.touch_distance());
    summary_.network = {n.clusters, n.largest, n.spans_x, n.spans_y};
    summary_.events.clear();
    for (const Event& e : model.registry().events()) {
      summary_.events.push_back(
          {e.step, e.cycle, name_of(e.kind), e.crack, e.end, e.partner, e.at});
    }
  }

  std::vector<TipRecord> record_tips(const Model& model, int step,
                                     const std::vector<StressIntensity>& intensities) {
    std::vector<TipRecord> active;
    summary_.tips.clear();
    const auto& cracks = model.registry().cracks();
    for (std::size_t c = 0; c < cracks.size(); ++c) {
      for (int end = 0; end < 2; ++end) {
        TipRecord tip;
        tip.step = step;
        tip.crack = int(c);
        tip.end = end;
        tip.at = cracks[c].end_point(end);
        const CrackEnd& state = cracks[c].ends[std::size_t(end)];
        tip.state = name_of(state.state);
        tip.partner = state.partner;
        tip.k_from = "";
        for (const StressIntensity& k : intensities) {
          if (k.crack != tip.crack || k.end != end) continue;
          tip.k1 = k.k1;
          tip.k2 = k.k2;
          tip.k_from = "integral";
          active.push_back(tip);
        }
        summary_.tips.push_back(tip);
      }
    }
    return active;
  }

  void measure(LocalId owned) {
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
    p.wall_s = communicator_.max(watch_.seconds());
  }

  const CaseSpec& spec_;
  Communicator& communicator_;
  std::span<Observer* const> observers_;
  Stopwatch watch_;
  Summary summary_;
  bool started_ = false;
};

/// A difference between the copies of the registry is a bug that would spoil everything after it.
void compare_registries(const Model& model) {
  const auto hash = std::int64_t(model.registry().hash() >> 2);
  // the mean of equal numbers is that number, and 62 bits leave room for a few ranks' sum
  const double low = model.communicator().min(double(hash >> 31));
  const double high = model.communicator().max(double(hash >> 31));
  const double low_bits = model.communicator().min(double(hash & 0x7fffffff));
  const double high_bits = model.communicator().max(double(hash & 0x7fffffff));
  if (low != high || low_bits != high_bits) {
    throw SolveError("the crack registries of the ranks differ; this is an error in the program.");
  }
}

void run_steps(const CaseSpec& spec, Model& model, Recorder& recorder) {
  const auto solver = make_solver(spec.solver);
  for (std::size_t k = 0; k < spec.load_factors.size(); ++k) {
    const double factor = spec.load_factors[k];
    const Stopwatch watch;
    compare_registries(model);
    const Equilibrium equilibrium = find_equilibrium(model, *solver, factor);
    const double seconds = watch.seconds();
    const auto tips = stress_intensities(model.basis(), model.registry().cracks(), model.material(),
                                         model.loads(factor), model.state(), model.communicator());
    recorder.step(model, int(k) + 1, factor, equilibrium, seconds, tips,
                  k + 1 == spec.load_factors.size());
  }
}

}  // namespace

Summary run_simulation(const CaseSpec& spec, const std::string& version, Communicator& communicator,
                       const Partitioner& partitioner, std::span<Observer* const> observers) {
  Recorder recorder(spec, version, communicator, observers);
  Model model(spec, communicator, partitioner);
  model.build_stiffness();
  recorder.start(model);
  try {
    run_steps(spec, model, recorder);
  } catch (const SolveError& error) {
    recorder.fail(error.what());
    throw;
  } catch (const InputError& error) {
    recorder.fail(error.what());
    throw;
  }
  recorder.finish();
  return recorder.summary();
}

CaseMeasure measure_case(const CaseSpec& spec, Communicator& communicator,
                         const Partitioner& partitioner) {
  const Model model(spec, communicator, partitioner);
  CaseMeasure measure;
  measure.elements = model.grid().element_count();
  measure.nodes = model.grid().node_count();
  measure.unknowns = communicator.sum(std::int64_t(model.unknowns().owned()));
  // vectors of CG and of the step, index lists of the grid, and the rows of special cells
  const std::int64_t special =
      communicator.sum(std::int64_t(model.unknowns().owned() - 2 * model.mesh().owned_nodes()));
  measure.bytes = 12 * 8 * measure.unknowns + 40 * measure.nodes + 2000 * special;
  measure.active_tips = model.registry().active_tips();
  return measure;
}

}  // namespace cdca
