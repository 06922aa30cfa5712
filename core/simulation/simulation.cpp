// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/simulation.hpp"

#include "core/base/errors.hpp"
#include "core/simulation/last_scale.hpp"
#include "core/simulation/load_stepper.hpp"

namespace cdca {

Summary run_simulation(const CaseSpec& spec, const std::string& version, Communicator& communicator,
                       const Partitioner& partitioner, std::span<Observer* const> observers,
                       const Checkpoint* from) {
  Recorder recorder(spec, version, communicator, observers);
  Model model(spec, communicator, partitioner);
  RunStart start;
  if (from) {
    start = {from->progress, put_back(*from, model)};
  } else {
    start.progress.joined = model.joins_loaded_boundaries();
    model.build_stiffness();
  }
  recorder.start(model, from ? from->story : RunStory());
  try {
    if (spec.loading.critical) {
      run_critical(model, recorder, std::move(start));
    } else {
      run_prescribed(model, recorder, std::move(start));
    }
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
  if (!model.contact().empty() && measure.nodes <= most_nodes_of_last_scale(spec)) {
    // the factor on every rank, as measured, and on the first rank matrices of two springs a face
    constexpr std::int64_t of_factor = 8000, matrices = 4;
    const auto springs = 2 * std::int64_t(model.contact().patches().size());
    measure.bytes += of_factor * measure.unknowns * communicator.size() +
                     matrices * std::int64_t(sizeof(double)) * springs * springs;
  }
  measure.active_tips = model.registry().active_tips();
  return measure;
}

}  // namespace cdca
