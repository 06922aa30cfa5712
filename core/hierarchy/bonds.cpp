// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/bonds.hpp"

#include "core/mesh/shape_functions.hpp"

namespace cdca {

namespace {

/// The bilinear functions of both sides as the face sees them.
void evaluate(const Bond& bond, const Vec2& at, const Vec2& h, const FaceGeometry& face,
              const ElasticMatrix& elastic, std::vector<FaceFunction>& functions) {
  functions.resize(8);
  const auto set = [&](GridIndex e, std::size_t first, double sign, double share) {
    const ShapeValues n = shape_functions(at - Vec2(e.i, e.j), h);
    for (std::size_t a = 0; a < 4; ++a) {
      functions[first + a].jump = sign * n.value[a];
      functions[first + a].traction = share * traction_of(n.gradient[a], face.normal, elastic);
    }
  };
  set(bond.plus, 0, 1.0, face.plus_share);
  set(bond.minus, 4, -1.0, 1 - face.plus_share);
}

}  // namespace

std::vector<Bond> finest_bonds(const ElementCuts& cuts, const std::vector<TipZone>& zones,
                               const ElasticMatrix& elastic, const FaceSprings& springs) {
  const StructuredGrid& grid = cuts.grid();
  std::vector<Bond> bonds;
  std::vector<FaceFunction> functions;
  for (const GlobalId id : cuts.touched_elements()) {
    for (const CrackFace& face : cuts.faces_of(grid.element_index(id))) {
      if (face.plus_element == face.minus_element && face.plus_part == face.minus_part) continue;
      const auto stretches = springs.on(face);
      if (stretches.empty()) continue;
      const FaceGeometry geometry(cuts, zones, face, elastic);
      Bond bond{face.plus_element, face.minus_element, face.plus_part, face.minus_part};
      for (const FaceStretch& s : stretches) {
        for (const FacePoint& p : plain_points(face, geometry, s.from, s.to)) {
          evaluate(bond, p.at, grid.element_size(), geometry, elastic, functions);
          Eigen::MatrixXd at_point = Eigen::MatrixXd::Zero(16, 16);
          add_springs(functions, geometry, s, p.weight, at_point);
          bond.stiffness += at_point;
        }
      }
      bonds.push_back(bond);
    }
  }
  return bonds;
}

PartStiffness held_entries(const Bond& bond, const LocalMesh& mesh, const CellUnknowns& unknowns) {
  PartStiffness held;
  std::vector<Eigen::Index> rows;
  const auto add = [&](GridIndex e, int part, Eigen::Index first) {
    const auto nodes = mesh.element_nodes(e);
    for (std::size_t a = 0; a < 4; ++a) {
      if (nodes[a] < 0) continue;
      const LocalId u = unknowns.of_piece(nodes[a], unknowns.piece(nodes[a], (a + 2) % 4, part));
      held.unknowns.insert(held.unknowns.end(), {u, u + 1});
      rows.insert(rows.end(), {first + 2 * Eigen::Index(a), first + 2 * Eigen::Index(a) + 1});
    }
  };
  add(bond.plus, bond.plus_part, 0);
  add(bond.minus, bond.minus_part, 8);
  held.matrix = bond.stiffness(rows, rows);
  return held;
}

}  // namespace cdca
