// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/external_forces.hpp"

#include "core/cells/tip_quadrature.hpp"
#include "core/mechanics/side_walk.hpp"

#include <algorithm>

namespace cdca {

namespace {

/// Collects point loads on the functions of parts.
class ForceCollector {
 public:
  ForceCollector(const BasisContext& context, std::span<double> forces)
      : c_(context), forces_(forces) {}

  void add(const PartBasis& basis, const Vec2& p, const Vec2& force, const Vec2* inside = nullptr) {
    basis.evaluate(p, functions_, inside);
    for (const BasisFunction& f : functions_) {
      if (f.unknown >= c_.unknowns.owned()) continue;
      const Vec2 share = f.value * f.along(force);
      forces_[std::size_t(f.unknown)] += share.x();
      forces_[std::size_t(f.unknown) + 1] += share.y();
    }
  }

 private:
  const BasisContext& c_;
  std::span<double> forces_;
  std::vector<BasisFunction> functions_;
};

Vec2 value_of(const LoadVector& load, const Vec2& x, double s) {
  return {load[0] ? load[0]->at(x.x(), x.y(), s) : 0.0,
          load[1] ? load[1]->at(x.x(), x.y(), s) : 0.0};
}

bool any(const LoadVector& load) { return load[0].has_value() || load[1].has_value(); }

void add_traction(const BasisContext& c, const ExternalLoads::SideTraction& load,
                  ForceCollector& collector) {
  const SideGeometry side = geometry_of(load.side);
  const StructuredGrid& grid = c.mesh.grid();
  for (const GridIndex e : elements_at(c.mesh, load.side)) {
    const Vec2 corner(e.i, e.j);
    for (const SidePortion& portion : c.cuts.side(e, side.element_side)) {
      const PartBasis basis(c, e, portion.part);
      const Vec2 from = side.at(portion.t0), to = side.at(portion.t1);
      const double length = (to - from).cwiseProduct(grid.element_size()).norm();
      for (const QuadraturePoint& q : line_quadrature(from, to, basis.tip_places())) {
        const Vec2 x = grid.from_grid(corner + q.at);
        collector.add(basis, q.at, q.weight * length * load.value(x));
      }
    }
  }
}

void add_point_force(const BasisContext& c, const ExternalLoads::PointForce& force,
                     ForceCollector& collector) {
  const Vec2 at = c.mesh.grid().to_grid(force.at);
  const GridIndex e = c.mesh.grid().element_at(at);
  if (c.mesh.find_element(e) < 0) return;
  const PartBasis basis(c, e, c.cuts.part_at(e, at));
  collector.add(basis, at - Vec2(e.i, e.j), force.value);
}

void add_body_force(const BasisContext& c, const std::function<Vec2(const Vec2&)>& body,
                    ForceCollector& collector) {
  const StructuredGrid& grid = c.mesh.grid();
  for (LocalId k = 0; k < c.mesh.element_count(); ++k) {
    const GridIndex e = c.mesh.element(k);
    const CutElement* cut = c.cuts.find(e);
    for (int part = 0; part < c.cuts.parts(e); ++part) {
      const PartBasis basis(c, e, part);
      const auto points =
          basis.has_tip_functions()
              ? tip_quadrature(cut, part, basis.tip_places(), grid.element_size(), orders_of_loads)
              : smooth_quadrature(cut, part, 3);
      for (const QuadraturePoint& q : points) {
        const Vec2 x = grid.from_grid(Vec2(e.i, e.j) + q.at);
        collector.add(basis, q.at, q.weight * grid.element_size().prod() * body(x));
      }
    }
  }
}

void add_face_loads(const BasisContext& c, const std::vector<FaceLoad>& loads,
                    ForceCollector& collector) {
  const StructuredGrid& grid = c.mesh.grid();
  for (LocalId k = 0; k < c.mesh.element_count(); ++k) {
    for (const CrackFace& face : c.cuts.faces_of(c.mesh.element(k))) {
      for (const FaceLoad& load : loads) {
        if (load.crack != face.crack) continue;
        const Vec2 along = (face.to - face.from).cwiseProduct(grid.element_size());
        const Vec2 n = turned_left(along).normalized();
        for (const int sign : {1, -1}) {
          const GridIndex e = sign > 0 ? face.plus_element : face.minus_element;
          const PartBasis basis(c, e, sign > 0 ? face.plus_part : face.minus_part);
          const Vec2 corner(e.i, e.j);
          const Vec2 shift = 1e-3 * sign * turned_left(face.to - face.from);
          for (const QuadraturePoint& q :
               line_quadrature(face.from - corner, face.to - corner, basis.tip_places())) {
            const Vec2 inside = q.at + shift;
            const Vec2 t = load.on_plus(grid.from_grid(corner + q.at), n);
            collector.add(basis, q.at, sign * q.weight * along.norm() * t, &inside);
          }
        }
      }
    }
  }
}

}  // namespace

ExternalLoads loads_at(const std::vector<BoundarySpec>& blocks, const LoadVector& body_force,
                       const std::vector<std::string>& crack_names, double s) {
  ExternalLoads loads;
  for (const BoundarySpec& b : blocks) {
    if (b.kind == BoundaryKind::side && any(b.displacement)) {
      loads.held_sides[std::size_t(b.side)] = true;
    }
    if (b.kind == BoundaryKind::side && any(b.traction)) {
      loads.tractions.push_back(
          {b.side, [&b, s](const Vec2& x) { return value_of(b.traction, x, s); }});
    }
    if (b.kind == BoundaryKind::point && any(b.force)) {
      loads.forces.push_back({b.at, value_of(b.force, b.at, s)});
    }
    if (b.kind == BoundaryKind::crack && b.pressure) {
      const auto it = std::find(crack_names.begin(), crack_names.end(), b.crack);
      loads.faces.push_back({int(it - crack_names.begin()), [&b, s](const Vec2& x, const Vec2& n) {
                               return Vec2(b.pressure->at(x.x(), x.y(), s) * n);
                             }});
    }
  }
  if (any(body_force)) {
    loads.body = [&body_force, s](const Vec2& x) { return value_of(body_force, x, s); };
  }
  return loads;
}

void add_external_forces(const BasisContext& context, const ExternalLoads& loads,
                         std::span<double> forces) {
  ForceCollector collector(context, forces);
  for (const auto& traction : loads.tractions) add_traction(context, traction, collector);
  for (const auto& force : loads.forces) add_point_force(context, force, collector);
  if (loads.body) add_body_force(context, loads.body, collector);
  if (!loads.faces.empty()) add_face_loads(context, loads.faces, collector);
}

}  // namespace cdca
