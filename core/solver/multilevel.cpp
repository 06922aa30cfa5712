// SPDX-License-Identifier: BSD-3-Clause
#include "core/solver/multilevel.hpp"

#include "core/solver/conjugate_gradients.hpp"

namespace cdca {

VCycle::VCycle(const Scales& scales) : scales_(scales), vectors_(scales.count()) {
  for (std::size_t k = 1; k < scales.count(); ++k) {
    const auto size = std::size_t(scales.scale(k).cells().count());
    vectors_[k] = {std::vector<double>(size), std::vector<double>(size), std::vector<double>(size)};
  }
}

void VCycle::operator()(std::span<const double> forces, std::span<double> scratch,
                        std::span<double> moves) {
  cycle(0, forces, scratch, moves);
}

void VCycle::cycle(std::size_t index, std::span<const double> forces, std::span<double> residual,
                   std::span<double> moves) {
  const Scale& scale = scales_.scale(index);
  if (index + 1 == scales_.count()) {
    scale.solve(forces, moves);
    return;
  }
  const CellSystem& cells = scale.cells();
  scale.start_plain_cells(forces, moves);
  cells.set_residual(forces, moves, residual);
  scale.move_windows(SweepDirection::forward, residual, moves);
  cells.clear_held(residual);

  Vectors& coarser = vectors_[index + 1];
  scale.forces_to_coarser(residual, coarser.forces);
  scales_.scale(index + 1).cells().clear_held(coarser.forces);
  cycle(index + 1, coarser.forces, coarser.residual, coarser.moves);
  scale.add_moves_of_coarser(coarser.moves, moves);
  cells.clear_held(moves);

  cells.set_residual(forces, moves, residual);
  scale.move_windows(SweepDirection::backward, residual, moves);
  scale.move_plain_cells(residual, moves);
}

namespace {

class Multilevel final : public EquilibriumSolver {
 public:
  Multilevel(const SolverOptions& options, const Scales& scales)
      : options_(options), scales_(scales) {}

  SolverReport solve(const CellSystem& system, std::span<const double> forces, std::span<double> u,
                     double scale, const Accuracy& accuracy) const override {
    VCycle cycle(scales_);
    return conjugate_gradients(
        system,
        [&cycle](const std::vector<double>& force, std::vector<double>& scratch,
                 std::vector<double>& move) { cycle(force, scratch, move); },
        forces, u, scale, options_, accuracy);
  }

 private:
  SolverOptions options_;
  const Scales& scales_;
};

}  // namespace

std::unique_ptr<EquilibriumSolver> make_multilevel(const SolverOptions& options,
                                                   const Scales& scales) {
  return std::make_unique<Multilevel>(options, scales);
}

}  // namespace cdca
