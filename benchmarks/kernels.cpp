// SPDX-License-Identifier: BSD-3-Clause
/// The parts of a V-cycle on the finest scale, against a triad over vectors of the same length.
#include "benchmarks/plate_case.hpp"
#include "core/simulation/equilibrium.hpp"
#include "core/solver/multilevel.hpp"

#include <benchmark/benchmark.h>

#include <map>
#include <memory>

namespace cdca::benchmarks {
namespace {

using Vector = std::vector<double>;

/// A plate of 640 x 1280 elements, built when it is first asked for.
struct Plate {
  explicit Plate(int cracks) : model(plate_in_tension(640, cracks), alone, Partitioner()) {
    model.build_stiffness();
  }
  static Plate& with(int cracks) {
    static std::map<int, std::unique_ptr<Plate>> plates;
    auto& plate = plates[cracks];
    if (!plate) plate = std::make_unique<Plate>(cracks);
    return *plate;
  }
  const Scale& finest() const { return model.hierarchy().scale(0); }
  std::size_t size() const { return std::size_t(model.unknowns().count()); }
  Vector coarse() const {
    return Vector(std::size_t(model.hierarchy().scale(1).cells().count()), 1e-3);
  }
  SerialCommunicator alone;
  Model model;
};

/// Runs `work` on two vectors x and y of the finest scale and reports unknowns per second.
template <class Work>
void measure(benchmark::State& state, const Work& work) {
  const Plate& plate = Plate::with(int(state.range(0)));
  Vector x(plate.size(), 1e-3), y(plate.size(), 0.0);
  for (auto _ : state) {
    work(plate, x, y);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(plate.size()));
}

void triad(benchmark::State& state) {
  Vector z(Plate::with(int(state.range(0))).size(), 2.0);
  measure(state, [&z](const Plate&, const Vector& x, Vector& y) {
    for (std::size_t k = 0; k < x.size(); ++k) y[k] = z[k] + 1.5 * x[k];
  });
}

void apply(benchmark::State& state) {
  measure(state, [](const Plate& plate, const Vector& x, Vector& y) {
    plate.model.stiffness().apply(x, y);
  });
}

void residual(benchmark::State& state) {
  const Vector forces(Plate::with(int(state.range(0))).size(), 1.0);
  measure(state, [&forces](const Plate& plate, const Vector& x, Vector& y) {
    plate.model.stiffness().set_residual(forces, x, y);
  });
}

void plain_cells(benchmark::State& state) {
  measure(state, [](const Plate& plate, const Vector& x, Vector& y) {
    plate.finest().move_plain_cells(x, y);
  });
}

void windows(benchmark::State& state) {
  measure(state, [](const Plate& plate, Vector& x, Vector& y) {
    plate.finest().move_windows(SweepDirection::forward, x, y);
  });
}

void to_coarser(benchmark::State& state) {
  Vector coarse = Plate::with(int(state.range(0))).coarse();
  measure(state, [&coarse](const Plate& plate, const Vector& x, const Vector&) {
    plate.finest().forces_to_coarser(x, coarse);
  });
}

void from_coarser(benchmark::State& state) {
  Vector coarse = Plate::with(int(state.range(0))).coarse();
  measure(state, [&coarse](const Plate& plate, const Vector&, Vector& y) {
    plate.finest().add_moves_of_coarser(coarse, y);
  });
}

void v_cycle(benchmark::State& state) {
  VCycle cycle(Plate::with(int(state.range(0))).model.hierarchy());
  Vector scratch(Plate::with(int(state.range(0))).size(), 0.0);
  measure(state, [&](const Plate&, const Vector& x, Vector& y) { cycle(x, scratch, y); });
}

#define CDCA_KERNEL(name) \
  BENCHMARK(name)->Arg(3)->Arg(50)->Unit(benchmark::kMillisecond)->Repetitions(5)
CDCA_KERNEL(triad);
CDCA_KERNEL(apply);
CDCA_KERNEL(residual);
CDCA_KERNEL(plain_cells);
CDCA_KERNEL(windows);
CDCA_KERNEL(to_coarser);
CDCA_KERNEL(from_coarser);
CDCA_KERNEL(v_cycle);

}  // namespace
}  // namespace cdca::benchmarks

BENCHMARK_MAIN();
