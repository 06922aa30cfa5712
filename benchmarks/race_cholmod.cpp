// SPDX-License-Identifier: BSD-3-Clause
/// The multilevel solver against a sparse direct one (CHOLMOD, supernodal, METIS ordering) on the
/// same system, in one process and on one core.
///
/// usage: bench_race_cholmod NX CRACKS [RUNS]; prints one line of comma-separated values.
#include "benchmarks/assembled.hpp"
#include "benchmarks/plate_case.hpp"
#include "core/base/process_memory.hpp"
#include "core/base/stopwatch.hpp"
#include "core/simulation/equilibrium.hpp"

#include <cholmod.h>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace cdca::benchmarks {
namespace {

struct Direct {
  double seconds = 0.0;  ///< assembly, analysis, factor and solution
  double bytes = 0.0;    ///< peak of what CHOLMOD takes
  std::vector<double> solution;
};

Direct solve_directly(const CellStiffness& cells, std::vector<double> forces) {
  Direct result;
  const Stopwatch watch;
  cholmod_common common;
  cholmod_l_start(&common);
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  common.postorder = 1;
  Assembled k(cells);
  const auto size = std::size_t(cells.owned());
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = size;
  matrix.nzmax = k.row.size();
  matrix.p = k.start.data();
  matrix.i = k.row.data();
  matrix.x = k.value.data();
  matrix.stype = 1;
  matrix.itype = CHOLMOD_LONG;
  matrix.xtype = CHOLMOD_REAL;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = 1;
  matrix.packed = 1;
  cholmod_factor* factor = cholmod_l_analyze(&matrix, &common);
  cholmod_l_factorize(&matrix, factor, &common);
  cholmod_dense right{};
  right.nrow = right.d = right.nzmax = size;
  right.ncol = 1;
  right.x = forces.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* u = cholmod_l_solve(CHOLMOD_A, factor, &right, &common);
  result.seconds = watch.seconds();
  if (u == nullptr || common.status != CHOLMOD_OK) {
    std::fprintf(stderr, "CHOLMOD failed with status %d\n", common.status);
    std::exit(1);
  }
  const auto* x = static_cast<const double*>(u->x);
  result.solution.assign(x, x + size);
  result.bytes = double(common.memory_usage);
  cholmod_l_free_dense(&u, &common);
  cholmod_l_free_factor(&factor, &common);
  cholmod_l_finish(&common);
  return result;
}

int race(int nx, int cracks, int runs) {
  const CaseSpec spec = plate_in_tension(nx, cracks);
  SerialCommunicator alone;
  std::vector<double> multilevel, direct;
  double unknowns = 0, iterations = 0, bytes = 0, difference = 0;
  for (int run = 0; run < runs; ++run) {
    const Stopwatch watch;
    Model model(spec, alone, Partitioner());
    model.build_stiffness();
    const Equilibrium found = find_equilibrium(model, *make_solver(model), 1.0);
    multilevel.push_back(watch.seconds());
    unknowns = double(model.unknowns().owned());
    iterations = found.solver.iterations;

    std::vector<double> u;
    const Direct other = solve_directly(model.stiffness(), forces_of(model, u));
    direct.push_back(other.seconds);
    bytes = other.bytes / unknowns;
    std::vector<double> product(u.size(), 0.0);
    for (std::size_t k = 0; k < other.solution.size(); ++k) u[k] += other.solution[k];
    model.stiffness().apply(u, product);
    const double energy = 0.5 * model.stiffness().dot(u, product);
    difference = std::abs(found.strain_energy - energy) / energy;
  }
  const double ours = median(multilevel), theirs = median(direct);
  std::printf("%d,%d,%.0f,%d,%.0f,%.4f,%.4f,%.2f,%.0f,%.1e\n", nx, cracks, unknowns, runs,
              iterations, ours, theirs, theirs / ours, bytes, difference);
  return 0;
}

}  // namespace
}  // namespace cdca::benchmarks

int main(int argc, char** argv) {
  cdca::keep_freed_memory();
  if (argc < 3) {
    std::puts(
        "nx,cracks,unknowns,runs,iterations,multilevel_s,cholmod_s,ratio,cholmod_bytes_per_unknown,"
        "energy_difference");
    return argc == 1 ? 0 : 2;
  }
  return cdca::benchmarks::race(std::atoi(argv[1]), std::atoi(argv[2]),
                                argc > 3 ? std::atoi(argv[3]) : 5);
}
