// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/energy_ledger.hpp"

namespace cdca {

EnergyLedger::EnergyLedger(const EnergyTotals& totals, std::vector<double> state,
                           std::vector<double> forces)
    : external_work_(totals.external_work),
      strain_energy_(totals.strain_energy),
      potential_(totals.potential),
      support_potential_(totals.support_potential),
      factor_(totals.factor),
      friction_(totals.friction),
      state_(std::move(state)),
      forces_(std::move(forces)) {}

EnergyTotals EnergyLedger::totals() const {
  return {external_work_, strain_energy_, potential_, support_potential_, factor_, friction_};
}

void EnergyLedger::keep(const Model& model, const Equilibrium& e, double factor) {
  const CellSystem& cells = model.stiffness();
  strain_energy_ = e.strain_energy;
  potential_ = cells.dot(e.external, model.state());
  support_potential_ = cells.dot(e.supports, model.state());
  factor_ = factor;
  state_ = model.state();
  forces_ = e.external;
  for (std::size_t k = 0; k < forces_.size(); ++k) forces_[k] += e.supports[k];
}

EnergyLedger::Loaded EnergyLedger::after_loads(const Model& model, const Equilibrium& e) {
  const CellSystem& cells = model.stiffness();
  if (!e.before_creep) return {model.state(), e.supports, 0.0};
  const auto& [state, supports] = *e.before_creep;
  const double work = cells.dot(e.external, model.state()) - cells.dot(e.external, state);
  return {state, supports, work};
}

void EnergyLedger::new_loads(const Model& model, const Equilibrium& e) {
  const Loaded loaded = after_loads(model, e);
  const std::size_t n = model.state().size();
  std::vector<double> mean(n), move(n);
  const bool first = state_.empty();
  for (std::size_t k = 0; k < n; ++k) {
    mean[k] = 0.5 * (e.external[k] + loaded.supports[k] + (first ? 0.0 : forces_[k]));
    move[k] = loaded.state[k] - (first ? 0.0 : state_[k]);
  }
  external_work_ += model.stiffness().dot(mean, move) + loaded.creep_work;
  keep(model, e, 0.0);
}

void EnergyLedger::new_cracks(const Model& model, const Equilibrium& e) {
  // supports have not moved, the loads have not changed
  external_work_ += model.stiffness().dot(e.external, model.state()) - potential_;
  keep(model, e, 0.0);
}

void EnergyLedger::new_factor(const Model& model, const Equilibrium& e, double factor) {
  if (!state_.empty()) {
    new_loads(model, e);
    factor_ = factor;
    return;
  }
  const Loaded loaded = after_loads(model, e);
  const double loads = model.stiffness().dot(e.external, loaded.state) / factor;
  const double supports = model.stiffness().dot(loaded.supports, loaded.state) / factor;
  const double loads_before = factor_ > 0 ? potential_ / factor_ : 0.0;
  const double supports_before = factor_ > 0 ? support_potential_ / factor_ : 0.0;
  // forces s f on displacements u; supports R on displacements s g
  external_work_ += 0.5 * (factor_ + factor) * (loads - loads_before) +
                    0.5 * (supports_before + supports) * (factor - factor_) + loaded.creep_work;
  keep(model, e, factor);
}

void EnergyLedger::let_cracks_grow() {
  state_.clear();
  forces_.clear();
}

}  // namespace cdca
