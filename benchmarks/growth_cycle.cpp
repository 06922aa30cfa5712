// SPDX-License-Identifier: BSD-3-Clause
/// One growth cycle (all tips advance by an element: cracks laid, equilibrium from the old one)
/// against a cold set-up and solve, in one process.
///
/// usage: bench_growth_cycle NX CRACKS [CYCLES]; prints one line of comma-separated values.
#include "benchmarks/plate_case.hpp"
#include "core/base/stopwatch.hpp"
#include "core/simulation/equilibrium.hpp"

#include <cstdio>
#include <cstdlib>

namespace cdca::benchmarks {
namespace {

CrackRegistry grown(const Model& model, int cycle) {
  CrackRegistry registry = model.registry();
  const double step = model.grid().smallest_side();
  for (std::size_t c = 0; c < model.registry().cracks().size(); ++c) {
    const Crack& crack = model.registry().cracks()[c];
    for (int end = 0; end < 2; ++end) {
      const Vec2 to = crack.end_point(end) + step * crack.end_tangent(end);
      registry.advance(int(c), end, to, TipState::active, -1, 1, cycle);
    }
  }
  return registry;
}

int measure(int nx, int cracks, int cycles) {
  const CaseSpec spec = plate_in_tension(nx, cracks);
  SerialCommunicator alone;
  std::vector<double> cold, set_up, warm;
  int cold_iterations = 0, warm_iterations = 0;
  double unknowns = 0.0;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    Stopwatch watch;
    Model model(spec, alone, Partitioner());
    model.build_stiffness();
    cold_iterations = find_equilibrium(model, *make_solver(model), 1.0).solver.iterations;
    cold.push_back(watch.seconds());
    unknowns = double(model.unknowns().owned());

    const CrackRegistry registry = grown(model, cycle);
    watch.restart();
    model.lay_cracks(registry);
    set_up.push_back(watch.seconds());
    warm_iterations = find_equilibrium(model, *make_solver(model), 1.0).solver.iterations;
    warm.push_back(watch.seconds());
  }
  std::printf("%d,%d,%.0f,%d,%.4f,%d,%.4f,%.4f,%d,%.3f\n", nx, cracks, unknowns, cycles,
              median(cold), cold_iterations, median(set_up), median(warm), warm_iterations,
              median(warm) / median(cold));
  return 0;
}

}  // namespace
}  // namespace cdca::benchmarks

int main(int argc, char** argv) {
  if (argc < 3) {
    std::puts(
        "nx,cracks,unknowns,runs,cold_s,cold_iterations,set_up_s,cycle_s,cycle_iterations,ratio");
    return argc == 1 ? 0 : 2;
  }
  return cdca::benchmarks::measure(std::atoi(argv[1]), std::atoi(argv[2]),
                                   argc > 3 ? std::atoi(argv[3]) : 5);
}
