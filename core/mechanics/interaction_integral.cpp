// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/interaction_integral.hpp"

#include "core/cells/quadrature.hpp"
#include "core/mechanics/contact_patches.hpp"
#include "core/mechanics/side_walk.hpp"
#include "core/mesh/shape_functions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cdca {

namespace {

/// The weight q of the domain, interpolated between its values at the nodes: inside every element
/// it is as smooth as the field itself, so that few points integrate it.
class DomainWeight {
 public:
  DomainWeight(const StructuredGrid& grid, GridIndex element, const Vec2& tip, double radius)
      : size_(grid.element_size()) {
    const auto corners = grid.corners(element);
    for (std::size_t a = 0; a < 4; ++a) {
      at_corner_[a] = plateau((grid.node_position(corners[a]) - tip).norm() / radius);
    }
  }
  bool nothing() const { return all(0.0); }
  bool flat() const { return all(at_corner_[0]); }
  /// p: inside the element, [0, 1].
  double value(const Vec2& p) const {
    const ShapeValues n = shape_functions(p, size_);
    double q = 0.0;
    for (std::size_t a = 0; a < 4; ++a) q += n.value[a] * at_corner_[a];
    return q;
  }
  /// 1/m, in global axes.
  Vec2 gradient(const Vec2& p) const {
    const ShapeValues n = shape_functions(p, size_);
    Vec2 g(0, 0);
    for (std::size_t a = 0; a < 4; ++a) g += n.gradient[a] * at_corner_[a];
    return g;
  }

 private:
  /// 1 up to half the radius, smoothly down to 0 at the radius.
  static double plateau(double share) {
    const double x = std::clamp(2 * share - 1, 0.0, 1.0);
    return 1 - x * x * x * (10 - 15 * x + 6 * x * x);
  }
  bool all(double q) const {
    return std::all_of(at_corner_.begin(), at_corner_.end(), [q](double at) { return at == q; });
  }

  Vec2 size_;
  std::array<double, 4> at_corner_{};
};

/// Is one of the tips nearer to the element than its larger side is long? Farther away near-tip
/// functions are smooth: in a whole element six points a direction are exact to 1e-9.
bool any_near(const std::vector<SingularPlace>& tips, const Vec2& h) {
  return std::any_of(tips.begin(), tips.end(), [&](const SingularPlace& tip) {
    const Vec2 nearest = tip.at.cwiseMax(0.0).cwiseMin(1.0);
    return (tip.at - nearest).cwiseProduct(h).norm() < h.maxCoeff();
  });
}

double distance_to_segment(const Vec2& a, const Vec2& b, const Vec2& x) {
  return (a + nearest_fraction(a, b, x) * (b - a) - x).norm();
}

/// How far the domain of a tip may reach without meeting anything.
double free_radius(const StructuredGrid& grid, const std::vector<Crack>& cracks,
                   const TipZone& zone) {
  const Vec2 x = zone.frame.tip();
  const Vec2 low = x - grid.origin(), high = grid.origin() + grid.size() - x;
  const double limit = 1e-5 * grid.smallest_side();
  double r = std::min(low.minCoeff(), high.minCoeff());
  for (const Crack& crack : cracks) {
    for (std::size_t k = 0; k < crack.segments(); ++k) {
      const Vec2 &a = crack.points[k], &b = crack.points[k + 1];
      if (!zone.frame.is_prolonged_by(a, b, limit)) r = std::min(r, distance_to_segment(a, b, x));
    }
    for (int end = 0; end < 2; ++end) {
      const double away = (crack.end_point(end) - x).norm();
      if (crack.ends[std::size_t(end)].state == TipState::active && away > limit)
        r = std::min(r, away);
    }
  }
  return 0.999 * r;
}

Eigen::Matrix2d tensor(const Voigt& s) {
  Eigen::Matrix2d t;
  t << s[0], s[2], s[2], s[1];
  return t;
}

/// The computed field at a place, in the axes of the tip.
struct ActualField {
  Eigen::Matrix2d stress;
  Eigen::Matrix2d gradient;
};

/// Sums of one tip, in its own axes.
class TipIntegral {
 public:
  TipIntegral(const BasisContext& c, const TipZone& zone, const Material& material,
              const ExternalLoads& loads, std::span<const double> state, double radius)
      : c_(c), zone_(zone), material_(material), loads_(loads), state_(state), radius_(radius) {
    axes_.row(0) = zone.frame.tangent();
    axes_.row(1) = turned_left(zone.frame.tangent());
  }

  /// Adds the share of this rank: m[0] for mode I, m[1] for mode II.
  void add(double m[2]) {
    const StructuredGrid& grid = c_.mesh.grid();
    const Vec2 reach = radius_ * grid.element_size().cwiseInverse() + Vec2(1, 1);
    const Vec2 centre = grid.to_grid(zone_.frame.tip());
    const GridIndex low = grid.element_at(centre - reach), high = grid.element_at(centre + reach);
    for (int j = low.j; j <= high.j; ++j) {
      for (int i = low.i; i <= high.i; ++i) {
        const GridIndex e{i, j};
        if (!c_.mesh.evaluates(e) || c_.mesh.find_element(e) < 0) continue;
        const DomainWeight q(grid, e, zone_.frame.tip(), radius_);
        if (q.nothing()) continue;
        for (int part = 0; part < c_.cuts.parts(e); ++part) add_part(e, part, q, m);
        for (const CrackFace& face : c_.cuts.faces_at(e)) {
          if (face.plus_element == e) add_face(face, true, q, m);
          if (face.minus_element == e) add_face(face, false, q, m);
        }
        add_rim(e, q, m);
      }
    }
  }

 private:
  ActualField actual(const PartBasis& basis, const Vec2& p, const Vec2* inside = nullptr) {
    basis.evaluate(p, functions_, inside);
    const Eigen::Matrix2d g = axes_ * field_value(functions_, state_).gradient * axes_.transpose();
    return {tensor(material_.stress(g)), g};
  }

  void add_part(GridIndex e, int part, const DomainWeight& q, double m[2]) {
    const bool flat = q.flat();
    if (flat && !loads_.body) return;
    const StructuredGrid& grid = c_.mesh.grid();
    const PartBasis basis(c_, e, part);
    const CutElement* cut = c_.cuts.find(e);
    // the kinks of near-tip functions at bends matter little under the smooth weight
    auto places = basis.tip_places();
    for (SingularPlace& place : places) place.bends.clear();
    const bool whole = !cut || cut->polygons.size() == 1;
    const auto points = whole && !any_near(places, grid.element_size())
                            ? smooth_quadrature(cut, part, 6)
                            : tip_quadrature(cut, part, places, grid.element_size());
    for (const QuadraturePoint& point : points) {
      const Vec2 x = grid.from_grid(Vec2(e.i, e.j) + point.at);
      const double r = zone_.frame.local(x).norm(), w = point.weight * grid.element_size().prod();
      if (r == 0.0) continue;
      const Vec2 dq = axes_ * q.gradient(point.at);
      const ActualField field = flat ? ActualField{} : actual(basis, point.at);
      const double angle = zone_.frame.angle(x);
      for (int mode = 0; mode < 2; ++mode) {
        const auto aux = williams_field(material_, mode + 1, r, angle);
        if (!flat) m[mode] += w * flux(field, aux).dot(dq);
        if (loads_.body) {
          m[mode] -= w * q.value(point.at) * Vec2(axes_ * loads_.body(x)).dot(aux.gradient.col(0));
        }
      }
    }
  }

  /// P_j
  static Vec2 flux(const ActualField& field, const WilliamsField& aux) {
    Vec2 p = field.stress * aux.gradient.col(0) + tensor(aux.stress) * field.gradient.col(0);
    p.x() -= field.stress.cwiseProduct(aux.gradient).sum();
    return p;
  }

  /// P_j m_j with a known traction t_i instead of s_ij m_j.
  static double flux_out(const ActualField& field, const WilliamsField& aux, const Vec2& m,
                         const Vec2& t) {
    return t.dot(aux.gradient.col(0)) + Vec2(tensor(aux.stress) * m).dot(field.gradient.col(0)) -
           field.stress.cwiseProduct(aux.gradient).sum() * m.x();
  }

  /// Behind the tip the primed field leaves the faces free, as far as the crack is straight.
  bool on_straight_part(const CrackFace& face) const {
    if (face.crack != zone_.crack) return false;
    const StructuredGrid& grid = c_.mesh.grid();
    for (const Vec2& end : {face.from, face.to}) {
      const Vec2 d = zone_.frame.local(grid.from_grid(end));
      const double limit = 1e-5 * grid.smallest_side();
      if (std::abs(d.y()) > limit || d.x() > limit) return false;
      if (d.norm() > zone_.frame.straight_length() + limit) return false;
    }
    return true;
  }

  void add_face(const CrackFace& face, bool plus, const DomainWeight& q, double m[2]) {
    const bool straight = on_straight_part(face);
    const FaceLoad* load = nullptr;
    for (const FaceLoad& l : loads_.faces) {
      if (l.crack == face.crack) load = &l;
    }
    const bool touches = loads_.contact && loads_.contact->may_touch(face.crack);
    if (straight && !load && !touches) return;
    const StructuredGrid& grid = c_.mesh.grid();
    const GridIndex e = plus ? face.plus_element : face.minus_element;
    const PartBasis basis(c_, e, plus ? face.plus_part : face.minus_part);
    const Vec2 corner(e.i, e.j);
    const Vec2 along = (face.to - face.from).cwiseProduct(grid.element_size());
    const Vec2 n = turned_left(along).normalized();
    const double sign = plus ? 1.0 : -1.0;
    const Vec2 shift = 1e-3 * sign * turned_left(face.to - face.from);
    // the left of the crack is the left of the way to the tip at end 1, the right at end 0
    const FaceSide side = face.crack != zone_.crack  ? FaceSide::none
                          : (zone_.end == 1) == plus ? FaceSide::plus
                                                     : FaceSide::minus;
    auto places = basis.tip_places();
    places.push_back({grid.to_grid(zone_.frame.tip()) - corner, {}});
    for (const auto& point : line_quadrature(face.from - corner, face.to - corner, places)) {
      const Vec2 x = grid.from_grid(corner + point.at);
      const double r = zone_.frame.local(x).norm();
      if (r == 0.0) continue;
      Vec2 t = load ? Vec2(sign * axes_ * load->on_plus(x, n)) : Vec2(0, 0);
      if (touches) t += sign * axes_ * loads_.contact->on_plus(face.crack, face.segment, x);
      const Vec2 inside = point.at + shift;
      const ActualField field = straight ? ActualField{} : actual(basis, point.at, &inside);
      const double w = point.weight * along.norm() * q.value(point.at);
      const double angle = zone_.frame.angle(x, side);
      for (int mode = 0; mode < 2; ++mode) {
        const auto aux = williams_field(material_, mode + 1, r, angle);
        m[mode] -= w * (straight ? t.dot(aux.gradient.col(0))
                                 : flux_out(field, aux, -sign * axes_ * n, t));
      }
    }
  }

  void add_rim(GridIndex e, const DomainWeight& q, double m[2]) {
    const StructuredGrid& grid = c_.mesh.grid();
    const bool at[4] = {e.i == 0, e.i == grid.nx() - 1, e.j == 0, e.j == grid.ny() - 1};
    const Side sides[4] = {Side::left, Side::right, Side::bottom, Side::top};
    const Vec2 outward[4] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (std::size_t k = 0; k < 4; ++k) {
      if (at[k]) add_rim_side(e, sides[k], outward[k], q, m);
    }
  }

  void add_rim_side(GridIndex e, Side side, const Vec2& outward, const DomainWeight& q,
                    double m[2]) {
    const StructuredGrid& grid = c_.mesh.grid();
    const SideGeometry geometry = geometry_of(side);
    const Vec2 corner(e.i, e.j), normal = axes_ * outward;
    for (const SidePortion& portion : c_.cuts.side(e, geometry.element_side)) {
      const PartBasis basis(c_, e, portion.part);
      const Vec2 from = geometry.at(portion.t0), to = geometry.at(portion.t1);
      const double length = (to - from).cwiseProduct(grid.element_size()).norm();
      for (const QuadraturePoint& point : line_quadrature(from, to, basis.tip_places())) {
        const Vec2 x = grid.from_grid(corner + point.at);
        const double r = zone_.frame.local(x).norm();
        if (r == 0.0) continue;
        const ActualField field = actual(basis, point.at);
        const Vec2 t = loads_.held_sides[std::size_t(side)] ? Vec2(field.stress * normal)
                                                            : traction_on(side, x);
        const double angle = zone_.frame.angle(x);
        for (int mode = 0; mode < 2; ++mode) {
          const auto aux = williams_field(material_, mode + 1, r, angle);
          m[mode] -= point.weight * length * q.value(point.at) * flux_out(field, aux, normal, t);
        }
      }
    }
  }

  Vec2 traction_on(Side side, const Vec2& x) const {
    Vec2 t(0, 0);
    for (const auto& load : loads_.tractions) {
      if (load.side == side) t += load.value(x);
    }
    return axes_ * t;
  }

  const BasisContext& c_;
  const TipZone& zone_;
  const Material& material_;
  const ExternalLoads& loads_;
  std::span<const double> state_;
  double radius_;
  Eigen::Matrix2d axes_;
  std::vector<BasisFunction> functions_;
};

/// The group of patches at a tip, when the faces touch at the tip.
const ContactGroup* touching_group(const ExternalLoads& loads, const std::vector<Crack>& cracks,
                                   const TipZone& zone) {
  if (!loads.contact) return nullptr;
  const Crack& crack = cracks[std::size_t(zone.crack)];
  const int segment = zone.end == 0 ? 0 : int(crack.segments()) - 1;
  const ContactPatch* patch = loads.contact->find(zone.crack, segment, crack.end_point(zone.end));
  if (!patch) return nullptr;
  const ContactGroup& group = loads.contact->group_of(*patch);
  return group.closed > 0.5 * group.length ? &group : nullptr;
}

/// K_I that opens the faces at the tip by their mean gap: g(r) = 8 K_I / E' sqrt(r / 2 pi).
double fitted_opening(const ContactGroup& group, const Material& material) {
  return 3.0 / 16 * group.gap * material.fracture_modulus() *
         std::sqrt(2 * std::numbers::pi / group.length);
}

}  // namespace

std::vector<StressIntensity> stress_intensities(
    const BasisContext& context, const std::vector<Crack>& cracks, const Material& material,
    const ExternalLoads& loads, std::span<const double> state, Communicator& communicator,
    const TipChoice& wanted, const DomainReach& reach) {
  const StructuredGrid& grid = context.mesh.grid();
  const double h = grid.element_size().maxCoeff();
  std::vector<double> sums;
  std::vector<StressIntensity> found;
  std::vector<const TipZone*> zones;
  for (const TipZone& zone : context.zones) {
    if (wanted && !wanted(zone.crack, zone.end)) continue;
    zones.push_back(&zone);
    sums.resize(2 * zones.size(), 0.0);
    const double room = free_radius(grid, cracks, zone);
    const double radius = std::max(std::min(reach.wanted * h, room), reach.smallest * h);
    TipIntegral(context, zone, material, loads, state, radius).add(&sums[2 * zones.size() - 2]);
    found.push_back({zone.crack, zone.end, 0.0, 0.0, radius});
  }
  communicator.sum(std::span<double>(sums));
  for (std::size_t z = 0; z < found.size(); ++z) {
    found[z].k1 = 0.5 * material.fracture_modulus() * sums[2 * z];
    found[z].k2 = 0.5 * material.fracture_modulus() * sums[2 * z + 1];
    if (const ContactGroup* group = touching_group(loads, cracks, *zones[z])) {
      found[z].k1 = fitted_opening(*group, material);
      found[z].k1_fitted = true;
    }
  }
  return found;
}

}  // namespace cdca
