// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/checkpoint.hpp"

namespace cdca {

namespace {

/// Without what follows from the cracks.
std::vector<ContactPatch> patches_to_keep(const ContactPatches& contact) {
  std::vector<ContactPatch> patches = contact.patches();
  for (ContactPatch& patch : patches) {
    patch.group = ContactPatch().group;
    patch.bodies = ContactPatch().bodies;
  }
  return patches;
}

}  // namespace

Checkpoint take_checkpoint(const Model& model, const EnergyLedger& energy, const Progress& progress,
                           RunStory story) {
  return {progress,
          std::move(story),
          energy.totals(),
          model.registry().cracks(),
          model.registry().events(),
          patches_to_keep(model.contact()),
          fields_of_cells(model.basis(), model.state(), energy.forces())};
}

EnergyLedger put_back(const Checkpoint& checkpoint, Model& model) {
  model.put_back(CrackRegistry(checkpoint.cracks, checkpoint.events), checkpoint.patches);
  Communicator& ranks = model.communicator();
  std::vector<double> forces(model.state().size(), 0.0);
  put_cells(rows_for_owners(checkpoint.cells, model.mesh(), ranks), model.basis(), ranks,
            model.state(), forces);
  model.stiffness().halo().copy_state(model.state());
  return {checkpoint.energy, model.state(), std::move(forces)};
}

}  // namespace cdca
