// SPDX-License-Identifier: BSD-3-Clause
/// The state of a run: body, cracks, cells and displacements. Everyone else borrows from it.
#pragma once

#include "core/cells/bodies.hpp"
#include "core/cells/cell_stiffness.hpp"
#include "core/cracks/crack_registry.hpp"
#include "core/hierarchy/hierarchy.hpp"
#include "core/mechanics/contact_spots.hpp"
#include "core/mechanics/external_forces.hpp"
#include "core/mechanics/interaction_integral.hpp"
#include "core/mechanics/material.hpp"
#include "core/mechanics/supports.hpp"
#include "core/simulation/case_spec.hpp"
#include "core/simulation/condensed_bodies.hpp"

#include <memory>
#include <optional>

namespace cdca {

class Model {
 public:
  /// Cracks, partition, this rank's part of the grid, pieces and unknowns; no stiffness yet.
  /// Throws InputError for cracks that the grid cannot hold and for bodies that nothing holds.
  /// Collective.
  Model(const CaseSpec& spec, Communicator& communicator, const Partitioner& partitioner);
  /// As above with a given partition of the cells.
  Model(const CaseSpec& spec, Communicator& communicator, const BlockPartition& partition);
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// Cell stiffness of the cracks as they are now. Collective.
  /// weak_share: of springs that hold loose bodies where they are, as a part of the cells' own
  /// stiffness.
  void build_stiffness(double weak_share = 1e-3);
  /// The same, where only springs have changed since: the rest is taken over. Collective.
  void renew_stiffness(double weak_share = 1e-3);
  /// Replaces the cracks: re-types the cells, carries the displacements over as a start for the
  /// next equilibrium, and rebuilds the stiffness. Only what has changed is cut and integrated
  /// anew. Bodies that nothing holds any more get a weak spring. Faces of such bodies touch until
  /// an equilibrium shows that they do not, unless it is already known. Collective.
  enum class OpenFaces { may_touch, are_open };
  void lay_cracks(CrackRegistry registry, OpenFaces open = OpenFaces::may_touch);

  /// As lay_cracks() with cracks and contact of a run that goes on; the displacements are left at
  /// 0. Throws IoError when the patches are not those of the cracks. Collective.
  void put_back(CrackRegistry registry, const std::vector<ContactPatch>& patches);
  /// States and slip of all faces, to go back to after a trial; lay_cracks() takes them up.
  struct ContactMemory {
    ContactPatches patches;
    ContactSpots spots;
    double rubbed;
  };
  ContactMemory contact_memory() const { return {contact_, spots_, rubbed_}; }
  void remember(const ContactMemory& memory) {
    contact_ = memory.patches;
    spots_ = memory.spots;
    rubbed_ = memory.rubbed;
  }

  /// Displacements that the faces' states and slip belong to, where those at hand are only a start
  /// for the next equilibrium; of the same cracks. Until one is accepted, or cracks are laid.
  void set_origin(std::vector<double> state) { origin_ = std::move(state); }
  const std::vector<double>& origin() const { return origin_.empty() ? state_ : origin_; }

  /// Takes over a registry that differs from the model's by its events only.
  void replace_events(CrackRegistry registry) { registry_ = std::move(registry); }

  /// Bodies into which the cracks have cut the grid.
  const Bodies& bodies() const { return *bodies_; }
  /// Whether weak springs hold some body: one that supports alone do not stop.
  bool has_weak_springs() const;
  /// Numbers of the bodies that neither supports nor touching faces hold.
  std::vector<std::size_t> loose_bodies() const;
  /// Numbers of the bodies in which places (m) lie. Collective.
  std::vector<std::size_t> bodies_at(const std::vector<Vec2>& places) const;
  /// A body, and not only pieces cut off it, still joins two loaded boundaries, and no part on
  /// which forces act has come off.
  bool joins_loaded_boundaries() const;

  const CaseSpec& spec() const { return spec_; }
  Communicator& communicator() const { return communicator_; }
  const StructuredGrid& grid() const { return grid_; }
  const LocalMesh& mesh() const { return mesh_; }
  const CrackRegistry& registry() const { return registry_; }
  const Material& material() const { return material_; }
  const Supports& supports() const { return supports_; }
  const ContactPatches& contact() const { return contact_; }
  ContactPatches& contact() { return contact_; }
  const ContactSpots& contact_spots() const { return spots_; }
  /// Adds what touching faces exert besides their springs, N per metre of thickness on own cells.
  void add_contact_forces(std::span<double> forces) const;
  /// Stored in the springs of faces less what u K u / 2 counts, J per metre. Collective.
  double contact_energy() const;
  /// What has changed since the last equilibrium.
  enum class Since { other_loads, other_cracks };
  /// Slip, opening and traction of this equilibrium become history. Returns the work that has gone
  /// into friction, J per metre: against the mean of the tractions before and after where the loads
  /// have changed, against those after where cracks have grown under the same loads. Collective.
  double accept_contact(Since since = Since::other_loads);
  /// On the way to an equilibrium: faces have slipped as far as the state says, and stick or slip
  /// from there. The work that this has taken counts in the next accept_contact(). Collective.
  void let_slip();
  /// From the next build_stiffness() on, weak springs hold all bodies, not only loose ones.
  void hold_all_bodies(bool all) { all_held_ = all; }
  const CellUnknowns& unknowns() const { return unknowns_; }
  const ElementCuts& cuts() const { return cuts_; }
  const std::vector<TipZone>& zones() const { return zones_; }
  const CellStiffness& stiffness() const { return *stiffness_; }
  /// K of the active tips under the loads of a load factor, in the state as it is. wanted: which
  /// tips; empty for all. Collective.
  std::vector<StressIntensity> stress_intensities(double load_factor,
                                                  const TipChoice& wanted = {}) const;
  /// The scales of the multilevel solver; empty for the other methods.
  const Hierarchy& hierarchy() const { return hierarchy_; }
  /// Whether the body can be condensed to its faces: only where one factor moves all cells;
  /// elsewhere it would take too much.
  bool condenses() const { return hierarchy_.count() == 1; }
  /// closed: answers with springs of closed faces, which are in the stiffness. Some are kept, for
  /// other springs that were in the stiffness, until cracks grow. Collective.
  FacesOfBody& condensed(const std::vector<ContactAnswer>& closed);
  BasisContext basis() const { return {mesh_, cuts_, zones_, unknowns_}; }
  Rectangle body() const { return {grid_.origin(), grid_.origin() + grid_.size()}; }
  /// Cracks that come nearer than this touch, m.
  double touch_distance() const { return 1e-3 * grid_.smallest_side(); }

  /// The loads at load factor s.
  ExternalLoads loads(double s) const;
  /// Displacements (and near-tip coefficients) of own cells and ghosts, m.
  std::vector<double>& state() { return state_; }
  const std::vector<double>& state() const { return state_; }
  /// Displacements with the cracks that they belong to.
  struct CrackedField {
    ElementCuts cuts;
    std::vector<TipZone> zones;
    CellUnknowns unknowns;
    std::vector<double> state;
  };
  CrackedField cracked_field() const { return {cuts_, zones_, unknowns_, state_}; }
  /// Takes displacements of other cracks as a start for the next equilibrium.
  void start_from(const CrackedField& field);
  /// Displacement and its gradient at a place x (m) of an element that this rank holds.
  FieldValue field_at(const Vec2& x) const;
  /// Stress (Pa) at x, when this rank evaluates the element there, x lies in the body, and no crack
  /// lies between it and `from`; otherwise nothing.
  std::optional<Voigt> visible_stress(const Vec2& from, const Vec2& x) const;

 private:
  void place_cracks();
  void find_zones();
  void close_new_faces();
  /// All but the displacements.
  void build_cells(const CellUnknowns::Kept* kept);
  void find_bodies();
  void make_stiffness(double weak_share, const CarriedCells* carried);
  /// Where springs of faces are not those that the stiffness was built with, on both sides.
  std::vector<GlobalId> turned_elements() const;
  std::size_t body_of(GridIndex element, int part) const;
  std::vector<ContactSpec> contact_laws() const;
  /// Faces that count as holding one body to another.
  enum class Holding { all, touching };
  /// Whether each body is held: by supports, or by faces of bodies that are.
  std::vector<char> held_bodies(Holding faces) const;
  /// Weak springs for bodies that supports alone leave free to move.
  std::vector<double> springs(double weak) const;
  void refuse_hidden_cracks() const;
  void refuse_loose_bodies() const;

  CaseSpec spec_;
  Communicator& communicator_;
  StructuredGrid grid_;
  Material material_;
  CrackRegistry registry_;
  LocalMesh mesh_;
  ElementCuts cuts_;
  std::vector<TipZone> zones_;
  CellUnknowns unknowns_;
  Supports supports_;
  std::unique_ptr<Bodies> bodies_;
  ContactPatches contact_;
  ContactSpots spots_;
  StiffnessCache stiffness_cache_;
  mutable IntensityCache intensity_cache_;
  ElasticMatrix elastic_;
  std::unique_ptr<FinestElements> elements_;
  std::unique_ptr<CellStiffness> stiffness_;
  SpringsOfElements built_springs_;  ///< of the patches, in the stiffness
  bool all_held_ = false;            ///< by weak springs
  double rubbed_ = 0.0;  ///< work of friction on the way to the next equilibrium, J per metre
  Hierarchy hierarchy_;
  CondensedBodies condensed_;
  double weak_share_ = 0.0;  ///< in the stiffness
  std::vector<double> state_;
  std::vector<double> origin_;  ///< empty: state_
};

}  // namespace cdca
