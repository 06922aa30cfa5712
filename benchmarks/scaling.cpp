// SPDX-License-Identifier: BSD-3-Clause
/// Time per phase, messages and memory on the ranks of mpirun.
///
/// usage: bench_scaling NX CRACKS [RUNS]; prints one line of comma-separated values.
#include "benchmarks/counting_communicator.hpp"
#include "benchmarks/plate_case.hpp"
#include "core/base/process_memory.hpp"
#include "core/base/stopwatch.hpp"
#include "core/simulation/equilibrium.hpp"
#include "parallel/metis_partition.hpp"
#include "parallel/mpi_communicator.hpp"

#include <cstdio>
#include <cstdlib>

namespace cdca::benchmarks {
namespace {

/// Seconds of each phase, of the slowest rank.
struct Phases {
  std::vector<double> cells, stiffness, solve, all;
};

void run_once(const CaseSpec& spec, CountingCommunicator& world, Phases& phases, int& iterations,
              Traffic& per_iteration, double& unknowns) {
  world.barrier();
  const Stopwatch watch;
  Model model(spec, world, metis_partition);
  const double cells = watch.seconds();
  model.build_stiffness();
  const double stiffness = watch.seconds();
  world.restart();
  iterations = find_equilibrium(model, *make_solver(model), 1.0).solver.iterations;
  const double solve = watch.seconds();
  per_iteration = world.traffic();
  phases.cells.push_back(world.max(cells));
  phases.stiffness.push_back(world.max(stiffness - cells));
  phases.solve.push_back(world.max(solve - stiffness));
  phases.all.push_back(world.max(solve));
  unknowns = double(world.sum(std::int64_t(model.unknowns().owned())));
}

int measure(Communicator& ranks, int nx, int cracks, int runs) {
  const double empty = double(peak_memory_bytes());
  CountingCommunicator world(ranks);
  const CaseSpec spec = plate_in_tension(nx, cracks);
  Phases phases;
  Traffic traffic;
  int iterations = 0;
  double unknowns = 0.0, memory = 0.0;
  for (int run = 0; run < runs; ++run) {
    run_once(spec, world, phases, iterations, traffic, unknowns);
    // of the first run alone: later ones find the heap in pieces
    if (run == 0) memory = double(peak_memory_bytes()) - empty;
  }
  const double steps = std::max(1, iterations);
  const double messages = world.max(double(traffic.messages)) / steps;
  const double bytes = world.max(double(traffic.bytes)) / steps;
  const double sums = double(traffic.reductions) / steps;
  const double worst = world.max(memory), all = world.sum(memory);
  world.barrier();
  const double triad = world.sum(triad_bandwidth(std::size_t(unknowns / double(world.size()))));
  if (!world.is_root()) return 0;
  std::printf("%d,%d,%d,%.0f,%d,%.4f,%.4f,%.4f,%.4f,%d,%.2f,%.1f,%.0f,%.1f,%.1f,%.1f,%.2f\n",
              world.size(), nx, cracks, unknowns, runs, median(phases.cells),
              median(phases.stiffness), median(phases.solve), median(phases.all), iterations,
              1e3 * median(phases.solve) / steps, messages, bytes, sums, worst / 1e6,
              all / unknowns, triad / 1e9);
  return 0;
}

}  // namespace
}  // namespace cdca::benchmarks

int main(int argc, char** argv) {
  cdca::keep_freed_memory();
  const cdca::MpiEnvironment environment(argc, argv);
  if (argc < 3) {
    std::puts(
        "ranks,nx,cracks,unknowns,runs,cells_s,stiffness_s,solve_s,all_s,iterations,"
        "iteration_ms,messages_per_iteration,bytes_per_iteration,reductions_per_iteration,"
        "largest_memory_mb,bytes_per_unknown,triad_gb_s");
    return argc == 1 ? 0 : 2;
  }
  cdca::MpiCommunicator world;
  return cdca::benchmarks::measure(world, std::atoi(argv[1]), std::atoi(argv[2]),
                                   argc > 3 ? std::atoi(argv[3]) : 5);
}
