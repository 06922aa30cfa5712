// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/bonds.hpp"

#include "core/mesh/shape_functions.hpp"

namespace cdca {

namespace {

/// The bilinear functions of both sides at a spot.
FaceSpot spot_of(const Bond& bond, const std::vector<FacePoint>& points, const Vec2& h,
                 const FaceGeometry& face, const ElasticMatrix& elastic) {
  FaceSpot spot;
  spot.compliance = face.compliance;
  spot.functions.resize(8);
  for (const FacePoint& p : points) spot.weight += p.weight;
  for (const FacePoint& p : points) {
    const auto add = [&](GridIndex e, std::size_t first, double sign, double side_share) {
      const ShapeValues n = shape_functions(p.at - Vec2(e.i, e.j), h);
      const double share = p.weight / spot.weight;
      for (std::size_t a = 0; a < 4; ++a) {
        FaceFunction& f = spot.functions[first + a];
        f.jump += sign * share * n.value[a] * Eigen::Matrix2d::Identity();
        f.traction += share * side_share * traction_of(n.gradient[a], face.normal, elastic);
      }
    };
    add(bond.plus, 0, 1.0, face.plus_share);
    add(bond.minus, 4, -1.0, 1 - face.plus_share);
  }
  return spot;
}

}  // namespace

std::vector<Bond> finest_bonds(const ElementCuts& cuts, const ElasticMatrix& elastic,
                               const FaceSprings& springs) {
  const StructuredGrid& grid = cuts.grid();
  std::vector<Bond> bonds;
  for (const GlobalId id : cuts.touched_elements()) {
    const GridIndex e = grid.element_index(id);
    const auto faces = cuts.faces_of(e);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const CrackFace& face = faces[k];
      if (face.plus_element == face.minus_element && face.plus_part == face.minus_part) continue;
      const auto stretches = springs.on(e, k);
      if (stretches.empty()) continue;
      const FaceGeometry geometry(cuts, face, elastic);
      Bond bond{face.plus_element, face.minus_element, face.plus_part, face.minus_part};
      for (const FaceStretch& s : stretches) {
        const FaceSpot spot = spot_of(bond, plain_points(face, geometry, s.from, s.to),
                                      grid.element_size(), geometry, elastic);
        Eigen::MatrixXd at_spot = Eigen::MatrixXd::Zero(16, 16);
        if (spot.weight > 0.0) SpotForms(spot, geometry).add_springs(s, at_spot);
        bond.stiffness += at_spot;
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
