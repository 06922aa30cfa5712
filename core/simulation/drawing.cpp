// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/drawing.hpp"

#include <cmath>
#include <unordered_map>

namespace cdca {

namespace {

class FieldDrawer {
 public:
  explicit FieldDrawer(const Model& model) : model_(model), context_(model.basis()) {}

  FieldPart draw() {
    const LocalMesh& mesh = model_.mesh();
    for (LocalId k = 0; k < mesh.element_count(); ++k) {
      const GridIndex e = mesh.element(k);
      if (!mesh.evaluates(e)) continue;
      const CutElement* cut = model_.cuts().find(e);
      if (cut) {
        for (const ElementPolygon& polygon : cut->polygons) add_polygon(e, *cut, polygon);
      } else {
        add_whole(e);
      }
    }
    return std::move(part_);
  }

 private:
  /// Corner points are shared between whole elements whose corner belongs to the same piece.
  void add_whole(GridIndex e) {
    const auto nodes = model_.mesh().element_nodes(e);
    const auto corners = model_.grid().corners(e);
    for (std::size_t a = 0; a < 4; ++a) {
      const LocalId u =
          model_.unknowns().of_piece(nodes[a], model_.unknowns().piece(nodes[a], (a + 2) % 4, 0));
      const auto [it, is_new] = point_of_.try_emplace(u, std::int64_t(part_.points.size() / 2));
      if (is_new) {
        const auto k = std::size_t(u);
        add_point(model_.grid().node_position(corners[a]),
                  Vec2(model_.state()[k], model_.state()[k + 1]));
      }
      part_.connectivity.push_back(it->second);
    }
    finish(e, 0, 1, Vec2(0.5, 0.5));
  }

  void add_polygon(GridIndex e, const CutElement& cut, const ElementPolygon& polygon) {
    const Vec2 corner(e.i, e.j);
    const Vec2 centre = centroid(polygon.loop);
    const PartBasis basis(context_, e, polygon.part);
    for (const Vec2& p : polygon.loop) {
      const Vec2 inside = p + 1e-3 * (centre - p);
      basis.evaluate(p, functions_, &inside);
      part_.connectivity.push_back(std::int64_t(part_.points.size() / 2));
      add_point(model_.grid().from_grid(corner + p),
                field_value(functions_, model_.state()).displacement);
    }
    finish(e, polygon.part, cut.parts, centre);
  }

  void add_point(const Vec2& x, const Vec2& u) {
    part_.points.insert(part_.points.end(), {x.x(), x.y()});
    part_.displacement.insert(part_.displacement.end(), {u.x(), u.y()});
  }

  void finish(GridIndex e, int part, int parts, const Vec2& centre) {
    part_.offsets.push_back(std::int64_t(part_.connectivity.size()));
    const PartBasis basis(context_, e, part);
    basis.evaluate(centre, functions_);
    const Voigt s = model_.material().stress(field_value(functions_, model_.state()).gradient);
    part_.stress.insert(part_.stress.end(), {s[0], s[1], model_.material().out_of_plane(s), s[2]});
    const double mean = 0.5 * (s[0] + s[1]), radius = std::hypot(0.5 * (s[0] - s[1]), s[2]);
    part_.principal.insert(part_.principal.end(), {mean + radius, mean - radius});
    part_.young.push_back(model_.material().young);
    part_.element.push_back(model_.grid().element(e));
    part_.kind.push_back(parts > 2                                   ? 3
                         : basis.has_tip_functions() && holds_tip(e) ? 2
                         : parts > 1                                 ? 1
                                                                     : 0);
    part_.pieces.push_back(parts);
    part_.owner.push_back(model_.mesh().rank());
  }

  bool holds_tip(GridIndex e) const {
    for (const PathTip& tip : model_.cuts().paths().tips()) {
      if (!tip.is_active) continue;
      const Vec2 d = tip.at - Vec2(e.i, e.j);
      if (d.x() >= 0 && d.x() <= 1 && d.y() >= 0 && d.y() <= 1) return true;
    }
    return false;
  }

  static Vec2 centroid(const std::vector<Vec2>& loop) {
    Vec2 sum(0, 0);
    double area = 0.0;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      const double a = cross(loop[k] - loop[0], loop[k + 1] - loop[0]);
      sum += a / 3 * (loop[0] + loop[k] + loop[k + 1]);
      area += a;
    }
    return sum / area;
  }

  const Model& model_;
  BasisContext context_;
  FieldPart part_;
  std::unordered_map<LocalId, std::int64_t> point_of_;
  std::vector<BasisFunction> functions_;
};

/// Displacement on one side of a face.
Vec2 side_displacement(const Model& model, const CrackFace& face, const Vec2& at, bool plus) {
  const GridIndex e = plus ? face.plus_element : face.minus_element;
  const PartBasis basis(model.basis(), e, plus ? face.plus_part : face.minus_part);
  const Vec2 p = at - Vec2(e.i, e.j);
  const Vec2 middle = 0.5 * (face.from + face.to) - Vec2(e.i, e.j);
  const Vec2 inside =
      p + 1e-3 * (middle - p) + (plus ? 1e-4 : -1e-4) * turned_left(face.to - face.from);
  std::vector<BasisFunction> functions;
  basis.evaluate(p, functions, &inside);
  return field_value(functions, model.state()).displacement;
}

}  // namespace

FieldPart draw_fields(const Model& model) { return FieldDrawer(model).draw(); }

CrackPart draw_cracks(const Model& model) {
  CrackPart part;
  const LocalMesh& mesh = model.mesh();
  for (LocalId k = 0; k < mesh.element_count(); ++k) {
    if (!mesh.evaluates(mesh.element(k))) continue;
    for (const CrackFace& face : model.cuts().faces_of(mesh.element(k))) {
      const Vec2 along =
          (face.to - face.from).cwiseProduct(model.grid().element_size()).normalized();
      for (const Vec2& at : {face.from, face.to}) {
        const Vec2 jump =
            side_displacement(model, face, at, true) - side_displacement(model, face, at, false);
        const Vec2 x = model.grid().from_grid(at);
        part.points.insert(part.points.end(), {x.x(), x.y()});
        part.opening.push_back(jump.dot(turned_left(along)));
        part.slip.push_back(jump.dot(along));
      }
      const Crack& crack = model.registry().cracks()[std::size_t(face.crack)];
      part.crack.push_back(face.crack);
      part.age.push_back(crack.born[std::size_t(face.segment)].step);
      const Vec2 middle = model.grid().from_grid(0.5 * (face.from + face.to));
      const ContactPatch* patch = model.contact().find(face.crack, face.segment, middle);
      const bool closed = patch && patch->now.state != ContactState::open;
      part.contact_state.push_back(patch ? int(patch->now.state) : 0);
      part.normal_traction.push_back(closed ? model.contact().group_of(*patch).normal : 0.0);
      part.tangential_traction.push_back(closed ? model.contact().group_of(*patch).tangential
                                                : 0.0);
    }
  }
  return part;
}

}  // namespace cdca
