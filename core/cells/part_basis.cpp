// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/part_basis.hpp"

#include "core/mesh/shape_functions.hpp"

#include <algorithm>

namespace cdca {

namespace {

/// On which side of the zone's crack all of a piece lies, if it does.
FaceSide side_of_piece(const BasisContext& c, const TipZone& zone, LocalId node, int piece) {
  const SpecialCell& cell = *c.unknowns.special(node);
  if (cell.pieces->count == 1) return FaceSide::none;
  const auto elements = c.mesh.grid().elements_round(c.mesh.node(node));
  bool above = false, below = false;
  for (std::size_t slot = 0; slot < 4; ++slot) {
    const auto& parts = cell.pieces->piece[slot];
    for (std::size_t part = 0; part < parts.size(); ++part) {
      if (parts[part] != piece) continue;
      const CutElement* cut = c.cuts.find(elements[slot]);
      const Vec2 inside = cut ? cut->place_in(int(part)) : Vec2(0.5, 0.5);
      const Vec2 x = c.mesh.grid().from_grid(Vec2(elements[slot].i, elements[slot].j) + inside);
      (zone.frame.polar(x).theta > 0 ? above : below) = true;
    }
  }
  if (above == below) return FaceSide::none;
  return above ? FaceSide::plus : FaceSide::minus;
}

}  // namespace

TipAtNode tip_at_node(const BasisContext& context, const TipZone& zone, LocalId node, int piece) {
  const Vec2 x = context.mesh.grid().node_position(context.mesh.node(node));
  const FaceSide side = side_of_piece(context, zone, node, piece);
  return {side, near_tip_functions(zone.frame.polar(x, side)).value};
}

PartBasis::PartBasis(const BasisContext& context, GridIndex element, int part)
    : corner_(context.mesh.grid().node_position({element.i, element.j})),
      size_(context.mesh.grid().element_size()) {
  const StructuredGrid& grid = context.mesh.grid();
  const auto nodes = context.mesh.element_nodes(element);
  const GlobalId id = grid.element(element);
  if (const CutElement* cut = context.cuts.find(element)) {
    for (const ElementPolygon& polygon : cut->polygons) {
      if (polygon.part == part && polygon.continues) slivers_.push_back(&polygon);
    }
  }
  for (std::size_t a = 0; a < 4; ++a) {
    pieces_[a] = -1;
    if (nodes[a] < 0) continue;
    const int piece = context.unknowns.piece(nodes[a], (a + 2) % 4, part);
    pieces_[a] = context.unknowns.of_piece(nodes[a], piece);
    for (const TipUnknowns& tip : context.unknowns.tips(nodes[a])) {
      const TipZone& zone = context.zones[std::size_t(tip.zone)];
      if (!zone.acts_on(id, part)) continue;
      tips_.push_back({a, &zone, &tip, tip_at_node(context, zone, nodes[a], piece)});
    }
  }
  // one zone after the other, so that its functions are evaluated once a point
  std::stable_sort(tips_.begin(), tips_.end(), [](const TipShape& s, const TipShape& t) {
    return s.zone->crack != t.zone->crack ? s.zone->crack < t.zone->crack
                                          : s.zone->end < t.zone->end;
  });
}

Vec2 PartBasis::position(const Vec2& p) const { return corner_ + p.cwiseProduct(size_); }

const Vec2* PartBasis::seen_from(const Vec2& p, const Vec2* inside) const {
  for (const ElementPolygon* sliver : slivers_) {
    if (contains(sliver->loop, p)) return &*sliver->continues;
  }
  return inside;
}

std::vector<LocalId> PartBasis::unknowns() const {
  std::vector<LocalId> first;
  for (const LocalId u : pieces_) {
    if (u >= 0) first.push_back(u);
  }
  for (const TipShape& tip : tips_) {
    for (LocalId l = 0; l < tip.unknowns->count; l += 2) first.push_back(tip.unknowns->first + l);
  }
  return first;
}

template <class Visit>
void PartBasis::for_each_function(const Vec2& p, const Vec2* inside, const Visit& visit) const {
  const ShapeValues n = shape_functions(p, size_);
  for (std::size_t a = 0; a < 4; ++a) {
    if (pieces_[a] >= 0) visit(pieces_[a], n.value[a], n.gradient[a], nullptr);
  }
  if (tips_.empty()) return;
  inside = seen_from(p, inside);
  NearTipValues f{};
  const TipZone* known = nullptr;
  for (const TipShape& tip : tips_) {
    if (tip.zone != known) {
      known = tip.zone;
      const TipFrame& frame = known->frame;
      f = near_tip_functions(inside ? frame.polar_beside(position(p), position(*inside))
                                    : frame.polar(position(p)));
    }
    Eigen::Vector4d values;
    Eigen::Matrix<double, 2, 4> gradients;
    for (std::size_t l = 0; l < 4; ++l) {
      const double shifted = f.value[l] - tip.at_node.values[l];
      const auto k = Eigen::Index(l);
      values[k] = n.value[tip.corner] * shifted;
      gradients.col(k) = shifted * n.gradient[tip.corner] + n.value[tip.corner] * f.gradient[l];
    }
    const bool modes = tip.unknowns->has_modes();
    if (!modes) {
      values = tip.unknowns->functions.transpose() * values;
      gradients = gradients * tip.unknowns->functions;
    }
    for (Eigen::Index k = 0; k < 4; ++k)
      visit(tip.unknowns->first + (modes ? 0 : 2 * LocalId(k)), values[k], gradients.col(k),
            modes ? &tip.zone->modes[std::size_t(k)] : nullptr);
  }
}

void PartBasis::evaluate(const Vec2& p, std::vector<BasisFunction>& functions,
                         const Vec2* inside) const {
  functions.clear();
  for_each_function(p, inside,
                    [&functions](LocalId unknown, double value, const Vec2& gradient,
                                 const Eigen::Matrix2d* directions) {
                      functions.push_back({unknown, value, gradient, directions});
                    });
}

void PartBasis::evaluate_gradients(const Vec2& p, double* x, double* y) const {
  for_each_function(p, nullptr,
                    [&x, &y](LocalId, double, const Vec2& gradient, const Eigen::Matrix2d*) {
                      *x++ = gradient.x();
                      *y++ = gradient.y();
                    });
}

std::vector<double> PartBasis::tip_signature() const {
  std::vector<double> signature;
  for (const TipShape& tip : tips_) {
    signature.insert(signature.end(), {double(tip.corner), tip.unknowns->has_modes() ? 1.0 : 0.0,
                                       double(int(tip.at_node.side))});
    for (const Vec2& p : tip.zone->frame.path()) signature.insert(signature.end(), {p.x(), p.y()});
  }
  return signature;
}

std::vector<SingularPlace> PartBasis::tip_places() const {
  std::vector<SingularPlace> places;
  const TipZone* known = nullptr;
  for (const TipShape& tip : tips_) {
    if (tip.zone == known) continue;
    known = tip.zone;
    // modes live farther from the tip, where a bend is a small kink: not worth following exactly
    const bool follows = std::any_of(tips_.begin(), tips_.end(), [&](const TipShape& t) {
      return t.zone == known && !t.unknowns->has_modes();
    });
    places.push_back({(known->frame.tip() - corner_).cwiseQuotient(size_),
                      follows ? known->frame.bends() : std::vector<double>()});
  }
  return places;
}

FieldValue field_value(const std::vector<BasisFunction>& functions, std::span<const double> state) {
  FieldValue value;
  for (const BasisFunction& f : functions) {
    const Vec2 v = f.moved({state[std::size_t(f.unknown)], state[std::size_t(f.unknown) + 1]});
    value.displacement += f.value * v;
    value.gradient += v * f.gradient.transpose();
  }
  return value;
}

}  // namespace cdca
