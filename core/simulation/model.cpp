// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/model.hpp"

#include "core/base/errors.hpp"
#include "core/cells/rigid_motions.hpp"
#include "core/cracks/junction_search.hpp"
#include "core/cracks/level_set.hpp"
#include "core/cracks/segments.hpp"
#include "core/mechanics/loaded_pieces.hpp"
#include "core/simulation/last_scale.hpp"
#include "core/simulation/state_transfer.hpp"

#include <algorithm>
#include <bit>
#include <sstream>
#include <utility>

namespace cdca {

namespace {

StructuredGrid grid_of(const DomainSpec& d) { return {d.origin, d.size, d.cells[0], d.cells[1]}; }

}  // namespace

Model::Model(const CaseSpec& spec, Communicator& communicator, const Partitioner& partitioner)
    : spec_(spec),
      communicator_(communicator),
      grid_(grid_of(spec.domain)),
      material_{spec.material.young, spec.material.poisson, spec.domain.plane_strain},
      hierarchy_({{}, most_nodes_of_last_scale(spec)}) {
  place_cracks();
  const auto weights = cell_weights(grid_, registry_.cracks(), spec_.tip_radius);
  mesh_ = LocalMesh(grid_,
                    partition_cells(grid_, weights, communicator_, partitioner,
                                    most_blocks(communicator_.size())),
                    communicator_.rank());
  build_cells(nullptr);
  state_.assign(std::size_t(unknowns_.count()), 0.0);
  refuse_loose_bodies();
}

Model::Model(const CaseSpec& spec, Communicator& communicator, const BlockPartition& partition)
    : spec_(spec),
      communicator_(communicator),
      grid_(grid_of(spec.domain)),
      material_{spec.material.young, spec.material.poisson, spec.domain.plane_strain},
      hierarchy_({{}, most_nodes_of_last_scale(spec)}) {
  place_cracks();
  mesh_ = LocalMesh(grid_, partition, communicator_.rank());
  build_cells(nullptr);
  state_.assign(std::size_t(unknowns_.count()), 0.0);
  refuse_loose_bodies();
}

void Model::place_cracks() {
  for (const CrackSpec& crack : spec_.cracks) registry_.add(crack.name, crack.points);
  // the grid does not resolve a ligament thinner than a tenth of an element
  const double thinnest = 0.1 * grid_.smallest_side();
  registry_.resolve_initial_meetings(body(), touch_distance(), thinnest);
  cuts_ = ElementCuts(grid_, lay_paths(grid_, registry_));
  refuse_hidden_cracks();
  find_zones();
  contact_ = ContactPatches(cuts_, contact_laws(), registry_.cracks(), nullptr);
}

void Model::find_zones() {
  zones_ = find_tip_zones(cuts_, registry_.cracks(), {spec_.tip_radius, material_.kolosov()});
  const auto laws = contact_laws();
  // what holds cohesive faces together leaves no singular field
  std::erase_if(zones_, [&](const TipZone& zone) {
    return laws[std::size_t(zone.crack)].law == ContactLaw::cohesive;
  });
}

std::vector<ContactSpec> Model::contact_laws() const {
  std::vector<ContactSpec> laws;
  for (const CrackSpec& crack : spec_.cracks) laws.push_back(crack.contact);
  laws.resize(registry_.cracks().size());  // faces that the case says nothing of never touch
  return laws;
}

void Model::build_cells(const CellUnknowns::Kept* kept) {
  condensed_.clear();
  origin_.clear();
  stiffness_cache_.begin_cycle();
  intensity_cache_.begin_cycle();
  unknowns_ = CellUnknowns(mesh_, cuts_, zones_, communicator_, kept);
  supports_ = Supports(basis(), spec_.boundaries);
  spots_ = ContactSpots(basis(), contact_, material_.elastic_matrix());
  find_bodies();
  elastic_ = material_.elastic_matrix();
  elements_ = std::make_unique<FinestElements>(basis(), elastic_, stiffness_cache_,
                                               contact_.empty() ? nullptr : &contact_);
}

void Model::find_bodies() {
  const LoadedPieces loaded(basis(), spec_.boundaries);
  bodies_ = std::make_unique<Bodies>(basis(), supports_.flags(unknowns_.count()), loaded.marks(),
                                     communicator_);
  if (contact_.empty()) return;
  spots_.find_bodies([&](GridIndex e, int part) { return int(body_of(e, part)); }, contact_,
                     communicator_);
}

std::size_t Model::body_of(GridIndex e, int part) const {
  const auto nodes = mesh_.element_nodes(e);
  std::size_t a = 0;
  while (nodes[a] < 0) ++a;
  return bodies_->body_of(nodes[a], unknowns_.piece(nodes[a], (a + 2) % 4, part));
}

void Model::close_new_faces() {
  const auto held = held_bodies(Holding::touching);
  for (ContactPatch& p : contact_.patches()) {
    const auto [a, b] = p.bodies;
    if (a < 0 || b < 0 || a == b || p.now.state != ContactState::open) continue;
    if (held[std::size_t(a)] && held[std::size_t(b)]) continue;
    p.now = touching(contact_.law_of(p));
  }
}

std::vector<char> Model::held_bodies(Holding faces) const {
  const double least = contact_.least_holding(spec_.solver.tolerance);
  std::vector<char> held;
  for (const Body& body : bodies_->list()) held.push_back(body.held);
  for (bool found = true; found;) {
    found = false;
    for (const ContactPatch& p : contact_.patches()) {
      if (faces != Holding::all && !ContactPatches::holds(p, least)) continue;
      const auto [a, b] = p.bodies;
      if (a < 0 || b < 0 || held[std::size_t(a)] == held[std::size_t(b)]) continue;
      held[std::size_t(held[std::size_t(a)] ? b : a)] = 1;
      found = true;
    }
  }
  return held;
}

void Model::add_contact_forces(std::span<double> forces) const {
  spots_.add_forces(contact_, unknowns_.owned(), forces);
}

double Model::contact_energy() const {
  return contact_.empty() ? 0.0 : spots_.energy_correction(contact_, state_, communicator_);
}

double Model::accept_contact(Since since) {
  origin_.clear();
  if (contact_.empty()) return 0.0;
  const double after = since == Since::other_loads ? 0.5 : 1.0;
  const double work = spots_.accept(contact_, state_, after, communicator_);
  contact_.accept();
  return work + std::exchange(rubbed_, 0.0);
}

void Model::let_slip() {
  rubbed_ += spots_.accept(contact_, state_, 1.0, communicator_);
  contact_.accept();
}

void Model::build_stiffness(double weak_share) { make_stiffness(weak_share, nullptr); }

void Model::renew_stiffness(double weak_share) {
  weak_share_ = weak_share;
  if (hierarchy_.count() == 1) {
    stiffness_->turn_springs(mesh_, *elements_, springs(weak_share));
    hierarchy_.turn_springs();
    return;
  }
  const CarriedCells carried(mesh_, unknowns_, *stiffness_, unknowns_, {{}, {}, turned_elements()},
                             supports_.flags(unknowns_.count()), springs(weak_share));
  make_stiffness(weak_share, &carried);
}

std::vector<GlobalId> Model::turned_elements() const {
  if (hierarchy_.count() < 2) return {};  // only windows ask for them
  return with_other_sides(elements_with_other_springs(built_springs_, contact_.springs()), cuts_);
}

void Model::make_stiffness(double weak_share, const CarriedCells* carried) {
  weak_share_ = weak_share;
  const auto held = supports_.flags(unknowns_.count());
  const auto weak = springs(weak_share);
  const FaceSprings* faces = contact_.empty() ? nullptr : &contact_;
  const bool multilevel = spec_.solver.method == SolverMethod::multilevel;
  const auto before = std::move(stiffness_);  // what is carried refers to it
  stiffness_ = std::make_unique<CellStiffness>(
      mesh_, unknowns_, *elements_, held, weak,
      multilevel ? hierarchy_.plan(basis()) : std::vector<GlobalId>(),
      multilevel ? Sweeps::none : Sweeps::one_after_the_other, communicator_, carried);
  if (multilevel) hierarchy_.build({basis(), elastic_, held, weak, faces, carried}, *stiffness_);
  if (hierarchy_.count() > 1) built_springs_ = contact_.springs();
}

FacesOfBody& Model::condensed(const std::vector<ContactAnswer>& closed) {
  const auto places = spots_.spring_places(closed, contact_, communicator_);
  return condensed_.of({places, weak_share_, all_held_, {}, {}}, [&] {
    return hierarchy_.compliance(places.size(), spots_.effects_on(places));
  });
}

void Model::lay_cracks(CrackRegistry registry, OpenFaces open) {
  const CellUnknowns old_unknowns = std::move(unknowns_);
  const ElementCuts old_cuts = std::move(cuts_);
  const std::vector<TipZone> old_zones = std::move(zones_);
  std::vector<double> old_state = std::move(state_);
  registry_ = std::move(registry);
  cuts_ = ElementCuts(grid_, lay_paths(grid_, registry_), old_cuts);
  contact_ = ContactPatches(cuts_, contact_laws(), registry_.cracks(), &contact_);
  find_zones();
  ChangedElements changed;
  changed.cuts = changed_cuts(old_cuts, cuts_);
  const CellUnknowns::Kept kept{old_unknowns, changed.cuts};
  build_cells(&kept);
  if (open == OpenFaces::may_touch) close_new_faces();
  origin_.clear();
  state_ = carried_state({mesh_, old_cuts, old_zones, old_unknowns}, std::move(old_state), basis());
  constexpr double weak_share = 1e-3;
  if (!stiffness_) {
    make_stiffness(weak_share, nullptr);
    return;
  }
  changed.functions = with_changed_zones(changed.cuts, old_zones, zones_);
  if (!contact_.empty()) {
    changed.cuts = with_other_sides(std::move(changed.cuts), cuts_);
    changed.functions = with_other_sides(std::move(changed.functions), cuts_);
  }
  changed.turned = turned_elements();
  const CarriedCells carried(mesh_, old_unknowns, *stiffness_, unknowns_, std::move(changed),
                             supports_.flags(unknowns_.count()), springs(weak_share));
  make_stiffness(weak_share, &carried);
}

void Model::start_from(const CrackedField& field) {
  state_ = carried_state({mesh_, field.cuts, field.zones, field.unknowns}, field.state, basis());
}

std::vector<std::size_t> Model::loose_bodies() const {
  const auto held = held_bodies(Holding::touching);
  std::vector<std::size_t> loose;
  for (std::size_t k = 0; k < held.size(); ++k) {
    if (!held[k]) loose.push_back(k);
  }
  return loose;
}

std::vector<std::size_t> Model::bodies_at(const std::vector<Vec2>& places) const {
  std::vector<std::int64_t> found;
  for (const Vec2& x : places) {
    const Vec2 at = grid_.to_grid(x);
    const GridIndex e = grid_.element_at(at);
    const bool here = mesh_.evaluates(e) && mesh_.find_element(e) >= 0;
    found.push_back(here ? std::int64_t(body_of(e, cuts_.part_at(e, at))) : 0);
  }
  communicator_.sum(std::span<std::int64_t>(found));
  return {found.begin(), found.end()};
}

void Model::put_back(CrackRegistry registry, const std::vector<ContactPatch>& patches) {
  registry_ = std::move(registry);
  cuts_ = ElementCuts(grid_, CrackPaths(grid_, registry_.cracks()));
  contact_ = ContactPatches(cuts_, contact_laws(), registry_.cracks(), nullptr);
  contact_.put_back(patches);
  find_zones();
  build_cells(nullptr);
  state_.assign(std::size_t(unknowns_.count()), 0.0);
  build_stiffness();
}

bool Model::has_weak_springs() const {
  const auto& bodies = bodies_->list();
  return all_held_ ||
         std::any_of(bodies.begin(), bodies.end(), [](const Body& b) { return !b.held; });
}

std::vector<double> Model::springs(double weak) const {
  if (!has_weak_springs()) return {};
  std::vector<double> springs(std::size_t(unknowns_.count()), 0.0);
  for (LocalId n = 0; n < mesh_.owned_nodes(); ++n) {
    for (int p = 0; p < unknowns_.pieces(n); ++p) {
      if (!all_held_ && bodies_->list()[bodies_->body_of(n, p)].held) continue;
      const auto u = std::size_t(unknowns_.of_piece(n, p));
      springs[u] = springs[u + 1] = weak;
    }
  }
  return springs;
}

bool Model::joins_loaded_boundaries() const {
  const auto held = held_bodies(Holding::touching);
  const double least = contact_.least_holding(spec_.solver.tolerance);
  const auto& bodies = bodies_->list();
  std::vector<std::uint64_t> marks;
  for (const Body& body : bodies) marks.push_back(body.marks);
  // bodies that touch carry the marks of each other
  for (bool found = true; found;) {
    found = false;
    for (const ContactPatch& p : contact_.patches()) {
      const auto [a, b] = p.bodies;
      if (!ContactPatches::holds(p, least) || a < 0 || b < 0) continue;
      auto &of_a = marks[std::size_t(a)], &of_b = marks[std::size_t(b)];
      if (of_a == of_b) continue;
      of_a = of_b = of_a | of_b;
      found = true;
    }
  }
  bool joined = false;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    // nothing balances the forces on a part that has come off
    if (!held[k] && (marks[k] & LoadedPieces::forces)) return false;
    joined = joined || (held[k] && std::popcount(marks[k] & LoadedPieces::boundaries) > 1);
  }
  return joined;
}

void Model::refuse_hidden_cracks() const {
  std::vector<Problem> problems;
  for (std::size_t c = 0; c < spec_.cracks.size(); ++c) {
    const Crack& crack = registry_.cracks()[c];
    if (crack.ends[0].state != TipState::active || crack.ends[1].state != TipState::active)
      continue;
    const GridIndex a = grid_.element_at(grid_.to_grid(crack.end_point(0)));
    const GridIndex b = grid_.element_at(grid_.to_grid(crack.end_point(1)));
    if (!(a == b)) continue;
    std::ostringstream text;
    text << "both tips of crack \"" << crack.name << "\" lie in one element (column " << a.i
         << ", row " << a.j
         << "); a crack must be longer than an element: refine the grid or leave the crack out.";
    problems.push_back({spec_.cracks[c].line, "crack[" + std::to_string(c) + "]", text.str()});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

void Model::refuse_loose_bodies() const {
  std::vector<Problem> problems;
  const auto& bodies = bodies_->list();
  const auto held = held_bodies(Holding::all);
  for (const Body& body : bodies) {
    if (held[std::size_t(&body - bodies.data())]) continue;
    std::ostringstream text;
    text << (bodies.size() == 1
                 ? "the supports leave the body free to move as a rigid whole"
                 : "the cracks cut off a part of the body that no support holds: the part at (");
    if (bodies.size() > 1) text << body.at.x() << ", " << body.at.y() << ")";
    text << "; prescribe displacements that stop both translations and the rotation"
         << (bodies.size() > 1 ? " of every part." : ".");
    const int line = spec_.boundaries.empty() ? spec_.domain.line : spec_.boundaries.front().line;
    problems.push_back({line, "boundary", text.str()});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

ExternalLoads Model::loads(double s) const {
  std::vector<std::string> names;
  for (const Crack& crack : registry_.cracks()) names.push_back(crack.name);
  ExternalLoads loads = loads_at(spec_.boundaries, spec_.domain.body_force, names, s);
  if (!contact_.empty()) loads.contact = &contact_;
  return loads;
}

std::vector<StressIntensity> Model::stress_intensities(double load_factor,
                                                       const TipChoice& wanted) const {
  const auto state = without_rigid_motions(basis(), *bodies_, state_, communicator_);
  return cdca::stress_intensities(basis(), registry_.cracks(), material_, loads(load_factor), state,
                                  communicator_, intensity_cache_, wanted);
}

FieldValue Model::field_at(const Vec2& x) const {
  const Vec2 at = grid_.to_grid(x);
  const GridIndex e = grid_.element_at(at);
  const PartBasis functions(basis(), e, cuts_.part_at(e, at));
  std::vector<BasisFunction> values;
  functions.evaluate(at - Vec2(e.i, e.j), values);
  return field_value(values, state_);
}

std::optional<Voigt> Model::visible_stress(const Vec2& from, const Vec2& x) const {
  const Rectangle inside = body();
  if ((x.array() <= inside.lower.array()).any() || (x.array() >= inside.upper.array()).any()) {
    return std::nullopt;
  }
  const GridIndex e = grid_.element_at(grid_.to_grid(x));
  if (!mesh_.evaluates(e) || mesh_.find_element(e) < 0) return std::nullopt;
  for (const Crack& crack : registry_.cracks()) {
    for (std::size_t k = 0; k < crack.segments(); ++k) {
      if (crossing_of(from, x, crack.points[k], crack.points[k + 1])) return std::nullopt;
    }
  }
  return material_.stress(field_at(x).gradient);
}

}  // namespace cdca
