// SPDX-License-Identifier: BSD-3-Clause
/// One growth cycle (tips advance by an element: cracks laid, equilibrium from the old one) against
/// a cold set-up and solve of the same plate, in one process.
///
/// usage: bench_growth_cycle NX CRACKS TIPS [RUNS]; prints one line of comma-separated values.
#include "benchmarks/plate_case.hpp"
#include "core/base/process_memory.hpp"
#include "core/base/stopwatch.hpp"
#include "core/simulation/equilibrium.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace cdca::benchmarks {
namespace {

/// The first `tips` tips go on by an element.
CrackRegistry grown(const Model& model, int tips) {
  CrackRegistry registry = model.registry();
  const double step = model.grid().smallest_side();
  for (int k = 0; k < std::min(tips, 2 * int(model.registry().cracks().size())); ++k) {
    const Crack& crack = model.registry().cracks()[std::size_t(k / 2)];
    const Vec2 to = crack.end_point(k % 2) + step * crack.end_tangent(k % 2);
    registry.advance(k / 2, k % 2, to, TipState::active, -1, {1, 0});
  }
  return registry;
}

int measure(int nx, int cracks, int tips, int runs) {
  const CaseSpec spec = plate_in_tension(nx, cracks);
  SerialCommunicator alone;
  std::vector<double> cold, set_up, warm, ratio;
  double first = 0.0;  // before the process has any memory
  int cold_iterations = 0, warm_iterations = 0;
  std::int64_t all = 0, factors = 0;
  double unknowns = 0.0;
  const std::int64_t empty = peak_memory_bytes();
  std::int64_t cold_peak = 0, peak = 0;
  for (int run = 0; run < runs; ++run) {
    Stopwatch watch;
    Model model(spec, alone, Partitioner());
    model.build_stiffness();
    cold_iterations = find_equilibrium(model, *make_solver(model), 1.0).solver.iterations;
    cold.push_back(watch.seconds());
    if (run == 0) {
      first = cold.back();
      cold_peak = peak_memory_bytes();
    }
    unknowns = double(model.unknowns().owned());
    all = model.hierarchy().factors().made();

    const CrackRegistry registry = grown(model, tips);
    watch.restart();
    model.lay_cracks(registry);
    set_up.push_back(watch.seconds());
    warm_iterations = find_equilibrium(model, *make_solver(model), 1.0).solver.iterations;
    warm.push_back(watch.seconds());
    ratio.push_back(warm.back() / cold.back());
    factors = model.hierarchy().factors().made();
    if (run == 0) peak = peak_memory_bytes();
  }
  std::printf("%d,%d,%d,%.0f,%d,%.4f,%d,%.4f,%.4f,%d,%.0f,%.0f,%.3f,%.4f,%.1f,%.1f\n", nx, cracks,
              tips, unknowns, runs, median(cold), cold_iterations, median(set_up), median(warm),
              warm_iterations, double(all), double(factors), median(ratio), first,
              double(cold_peak - empty) / unknowns, double(peak - empty) / unknowns);
  return 0;
}

}  // namespace
}  // namespace cdca::benchmarks

int main(int argc, char** argv) {
  cdca::keep_freed_memory();
  if (argc < 4) {
    std::puts(
        "nx,cracks,tips,unknowns,runs,cold_s,cold_iterations,set_up_s,cycle_s,cycle_iterations,"
        "windows,windows_factored,ratio,first_s,cold_bytes,bytes");
    return argc == 1 ? 0 : 2;
  }
  return cdca::benchmarks::measure(std::atoi(argv[1]), std::atoi(argv[2]), std::atoi(argv[3]),
                                   argc > 4 ? std::atoi(argv[4]) : 5);
}
