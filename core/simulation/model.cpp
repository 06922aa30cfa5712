// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/model.hpp"

#include "core/base/errors.hpp"
#include "core/cells/bodies.hpp"
#include "core/cracks/level_set.hpp"

#include <sstream>

namespace cdca {

namespace {

StructuredGrid grid_of(const DomainSpec& d) { return {d.origin, d.size, d.cells[0], d.cells[1]}; }

}  // namespace

Model::Model(const CaseSpec& spec, Communicator& communicator, const Partitioner& partitioner)
    : spec_(spec),
      communicator_(communicator),
      grid_(grid_of(spec.domain)),
      material_{spec.material.young, spec.material.poisson, spec.domain.plane_strain} {
  place_cracks();
  const auto weights = cell_weights(grid_, registry_.cracks(), spec_.tip_radius);
  build_cells(partition_cells(grid_, weights, communicator_, partitioner));
}

Model::Model(const CaseSpec& spec, Communicator& communicator, const BlockPartition& partition)
    : spec_(spec),
      communicator_(communicator),
      grid_(grid_of(spec.domain)),
      material_{spec.material.young, spec.material.poisson, spec.domain.plane_strain} {
  place_cracks();
  build_cells(partition);
}

void Model::place_cracks() {
  for (const CrackSpec& crack : spec_.cracks) registry_.add(crack.name, crack.points);
  registry_.resolve_initial_meetings(body(), touch_distance());
  cuts_ = ElementCuts(grid_, CrackPaths(grid_, registry_.cracks()));
  refuse_hidden_cracks();
  zones_ = find_tip_zones(cuts_, registry_.cracks(), spec_.tip_radius);
}

void Model::build_cells(const BlockPartition& partition) {
  mesh_ = LocalMesh(grid_, partition, communicator_.rank());
  unknowns_ = CellUnknowns(mesh_, cuts_, zones_, communicator_);
  supports_ = Supports(basis(), spec_.boundaries);
  state_.assign(std::size_t(unknowns_.count()), 0.0);
  refuse_loose_bodies();
}

void Model::build_stiffness() {
  stiffness_ = std::make_unique<CellStiffness>(basis(), material_.elastic_matrix(),
                                               supports_.flags(unknowns_.count()), communicator_);
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
  const auto bodies = find_bodies(basis(), supports_.flags(unknowns_.count()), communicator_);
  for (const Body& body : bodies) {
    if (body.held) continue;
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
  return loads_at(spec_.boundaries, spec_.domain.body_force, names, s);
}

FieldValue Model::field_at(const Vec2& x) const {
  const Vec2 at = grid_.to_grid(x);
  const GridIndex e = grid_.element_at(at);
  const PartBasis functions(basis(), e, cuts_.part_at(e, at));
  std::vector<BasisFunction> values;
  functions.evaluate(at - Vec2(e.i, e.j), values);
  return field_value(values, state_);
}

}  // namespace cdca
