// SPDX-License-Identifier: BSD-3-Clause
/// Where the work of the loads goes.
#pragma once

#include "core/simulation/equilibrium.hpp"

namespace cdca {

/// What a ledger has added up, J per metre of thickness.
struct EnergyTotals {
  double external_work = 0.0;
  double strain_energy = 0.0;      ///< at the last equilibrium
  double potential = 0.0;          ///< of the loads there: forces times displacements
  double support_potential = 0.0;  ///< of the supports there
  double factor = 0.0;             ///< that the loads there are proportional to
  double friction = 0.0;           ///< work against friction so far
};

/// Adds up the work of loads and supports from one equilibrium to the next; what is not stored as
/// strain energy has been spent on friction and new cracks. J per metre of thickness.
class EnergyLedger {
 public:
  EnergyLedger() = default;
  /// Goes on from totals(), and from the displacements and forces() of the last equilibrium.
  EnergyLedger(const EnergyTotals& totals, std::vector<double> state, std::vector<double> forces);

  /// The next equilibrium with the same cracks as the last one, under other loads: trapezoidal,
  /// which is exact for a linear body, and balances what friction takes (also trapezoidal) for any.
  /// Where bodies have crept there, the loads have changed before, and were at rest meanwhile; so
  /// also in new_factor().
  void new_loads(const Model& model, const Equilibrium& equilibrium);
  /// The next equilibrium under the same loads with longer cracks.
  void new_cracks(const Model& model, const Equilibrium& equilibrium);
  /// The next equilibrium under loads and displacements proportional to a factor. Where cracks have
  /// grown since the last one, factor and cracks are taken to have changed in step with each other.
  void new_factor(const Model& model, const Equilibrium& equilibrium, double factor);
  /// The next equilibrium will be one of other cracks.
  void let_cracks_grow();

  /// Friction has taken so much since the last time.
  void add_friction(double work) { friction_ += work; }
  /// The body has come apart: what was stored is spent.
  void broken() { strain_energy_ = 0.0; }

  double external_work() const { return external_work_; }
  double friction() const { return friction_; }
  /// External work less strain energy: spent on friction and new cracks.
  double dissipated() const { return external_work_ - strain_energy_; }

  EnergyTotals totals() const;
  /// Of loads and supports at the last equilibrium, on own cells; empty where the next one does not
  /// ask for them.
  const std::vector<double>& forces() const { return forces_; }

 private:
  /// Where the loads have done their work, and what they do from there on, at rest.
  struct Loaded {
    const std::vector<double>&state, &supports;
    double creep_work;
  };
  static Loaded after_loads(const Model& model, const Equilibrium& equilibrium);
  void keep(const Model& model, const Equilibrium& equilibrium, double factor);

  double external_work_ = 0.0;
  double strain_energy_ = 0.0;
  double potential_ = 0.0;  ///< of the loads at the last equilibrium: forces times displacements
  double support_potential_ = 0.0;
  double factor_ = 0.0;
  double friction_ = 0.0;
  std::vector<double> state_;
  std::vector<double> forces_;  ///< loads and supports together
};

}  // namespace cdca
