// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/critical_state.hpp"

#include "core/base/errors.hpp"
#include "core/simulation/critical_factor.hpp"
#include "core/simulation/recorded_solve.hpp"

#include <cmath>

namespace cdca {

namespace {

/// Steps of the load longer than this part of it begin at a stop.
constexpr double long_way = 0.1;

/// An equilibrium found at factor 1, at another factor.
void scale(Model& model, Equilibrium& equilibrium, std::vector<TipAssessment>& tips,
           double factor) {
  for (double& u : model.state()) u *= factor;
  for (double& f : equilibrium.external) f *= factor;
  for (double& f : equilibrium.supports) f *= factor;
  for (Vec2& r : equilibrium.reactions) r *= factor;
  equilibrium.strain_energy *= factor * factor;
  for (TipAssessment& tip : tips) {
    tip.intensity.k1 *= factor;
    tip.intensity.k2 *= factor;
    tip.judgement.u_tension *= factor;
    tip.judgement.u_shear *= factor;
  }
}

CriticalState scaled_to_critical(Model& model, const EquilibriumSolver& solver,
                                 const GrowthCriterion& criterion, const CriticalStart& start,
                                 Recorder& recorder) {
  CriticalState found{solve_recorded(model, solver, 1.0, recorder), {}, 1.0, true, start.energy};
  found.tips = criterion.assess(model, 1.0);
  const double u = greatest_index(found.tips);
  found.grows = u > 0.0;
  if (found.grows) found.factor = 1.0 / u;
  scale(model, found.equilibrium, found.tips, found.factor);
  return found;
}

CriticalState searched_to_critical(Model& model, const EquilibriumSolver& solver,
                                   const GrowthCriterion& criterion, const CriticalStart& start,
                                   Recorder& recorder) {
  constexpr int most = 100;
  const Model::ContactMemory at_start = model.contact_memory();
  Model::ContactMemory at_stop = at_start;  // where every trial begins
  CriticalFactor search(start.last_factor, start.first_factor);
  CriticalState found;
  found.energy = start.energy;
  for (int round = 0; round < most; ++round) {
    const double next = search.next();
    if (search.back_at_start()) {
      at_stop = at_start;
      found.energy = start.energy;
    } else if (round > 0 && search.on_the_way() &&
               std::abs(next - found.factor) > long_way * found.factor) {
      const bool loads_at_rest = round == 1 && found.factor == start.last_factor;
      found.energy.new_factor(model, found.equilibrium, found.factor);
      accept_contact(model, loads_at_rest ? Model::Since::other_cracks : Model::Since::other_loads,
                     found.energy);
      at_stop = model.contact_memory();
    }
    if (round > 0) {
      model.remember(at_stop);
      model.renew_stiffness();
    }
    found.factor = next;
    found.equilibrium = solve_recorded(model, solver, found.factor, recorder);
    found.tips = criterion.assess(model, found.factor);
    search.tell(greatest_index(found.tips));
    if (!search.ended()) continue;
    found.grows = search.grows();
    return found;
  }
  throw ContactError(
      "the load factor at which the next tip grows was not found; the states of "
      "touching faces change with it.");
}

}  // namespace

CriticalState find_critical(Model& model, const EquilibriumSolver& solver,
                            const GrowthCriterion& criterion, const CriticalStart& start,
                            Recorder& recorder) {
  return model.contact().empty() ? scaled_to_critical(model, solver, criterion, start, recorder)
                                 : searched_to_critical(model, solver, criterion, start, recorder);
}

}  // namespace cdca
