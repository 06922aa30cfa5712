// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/intensity_weights.hpp"

#include "core/cells/stiffness_cache.hpp"
#include "core/cells/tip_quadrature.hpp"
#include "core/mechanics/contact_patches.hpp"
#include "core/mechanics/domain_weight.hpp"
#include "core/mechanics/side_walk.hpp"
#include "core/mechanics/williams.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

namespace {

/// Is one of the tips nearer to the element than its larger side is long? Farther away near-tip
/// functions are smooth: in a whole element six points a direction are exact to 1e-9.
bool any_near(const std::vector<SingularPlace>& tips, const Vec2& h) {
  return std::any_of(tips.begin(), tips.end(), [&](const SingularPlace& tip) {
    const Vec2 nearest = tip.at.cwiseMax(0.0).cwiseMin(1.0);
    return (tip.at - nearest).cwiseProduct(h).norm() < h.maxCoeff();
  });
}

Eigen::Matrix2d tensor(const Voigt& s) {
  Eigen::Matrix2d t;
  t << s[0], s[2], s[2], s[1];
  return t;
}

/// Adds up the weights of one element.
class ElementSum {
 public:
  ElementSum(const BasisContext& c, GridIndex element, const std::vector<PartBasis>& bases,
             const IntegralDomain& domain, const Material& material)
      : c_(c),
        grid_(c.mesh.grid()),
        e_(element),
        corner_(element.i, element.j),
        bases_(bases),
        domain_(domain),
        material_(material),
        axes_(domain.axes()),
        q_(grid_, element, domain.zone.frame.tip(), domain.radius) {
    for (const PartBasis& basis : bases)
      sums_.emplace_back(Eigen::MatrixX2d::Zero(2 * Eigen::Index(basis.unknowns().size()), 2));
  }

  ElementWeights weights() {
    for (std::size_t part = 0; part < bases_.size() && !q_.flat(); ++part) add_part(part);
    for (const CrackFace& face : c_.cuts.faces_at(e_)) {
      if (domain_.on_straight_part(grid_, face)) continue;
      if (face.plus_element == e_) add_face(face, true);
      if (face.minus_element == e_) add_face(face, false);
    }
    for (const Side side : sides_at(grid_, e_)) add_rim(side);
    return std::move(sums_);
  }

 private:
  /// Adds w times the field's gradient times `by_gradient` of each mode, both in the tip's axes.
  void add(std::size_t part, double w, const std::array<Eigen::Matrix2d, 2>& by_gradient) {
    for (int mode = 0; mode < 2; ++mode) {
      const Eigen::Matrix2d turned = w * axes_.transpose() * by_gradient[std::size_t(mode)] * axes_;
      Eigen::Index row = -2;
      LocalId last = -1;
      for (const BasisFunction& f : functions_) {
        if (f.unknown != last) row += 2;
        last = f.unknown;
        sums_[part].col(mode).segment<2>(row) += f.along(turned * f.gradient);
      }
    }
  }

  /// sigma : t as a form of the gradient.
  Eigen::Matrix2d of_stress(const Eigen::Matrix2d& t) const {
    return tensor(material_.stress(0.5 * (t + t.transpose())));
  }

  void add_part(std::size_t part) {
    const CutElement* cut = c_.cuts.find(e_);
    // the kinks of near-tip functions at bends matter little under the smooth weight
    auto places = bases_[part].tip_places();
    for (SingularPlace& place : places) place.bends.clear();
    const bool whole = !cut || cut->polygons.size() == 1;
    const auto points =
        places.empty() || (whole && !any_near(places, grid_.element_size()))
            ? smooth_quadrature(cut, int(part), 6)
            : tip_quadrature(cut, int(part), places, grid_.element_size(), orders_of_intensities);
    for (const QuadraturePoint& point : points) {
      const Vec2 x = grid_.from_grid(corner_ + point.at);
      const double r = domain_.zone.frame.local(x).norm();
      if (r == 0.0) continue;
      const Vec2 dq = axes_ * q_.gradient(point.at);
      const double angle = domain_.zone.frame.angle(x);
      std::array<Eigen::Matrix2d, 2> flux;  // P_j q,_j
      for (int mode = 0; mode < 2; ++mode) {
        const auto aux = williams_field(material_, mode + 1, r, angle);
        Eigen::Matrix2d& f = flux[std::size_t(mode)];
        f = of_stress(dq * aux.gradient.col(0).transpose() - dq.x() * aux.gradient);
        f.col(0) += tensor(aux.stress) * dq;
      }
      bases_[part].evaluate(point.at, functions_);
      add(part, point.weight * grid_.element_size().prod(), flux);
    }
  }

  /// P_j m_j; traction_known: without s_ij m_j u'_i,1.
  std::array<Eigen::Matrix2d, 2> flux_out(double r, double angle, const Vec2& m,
                                          bool traction_known) const {
    std::array<Eigen::Matrix2d, 2> flux;
    for (int mode = 0; mode < 2; ++mode) {
      const auto aux = williams_field(material_, mode + 1, r, angle);
      Eigen::Matrix2d t = -m.x() * aux.gradient;
      if (!traction_known) t += m * aux.gradient.col(0).transpose();
      Eigen::Matrix2d& f = flux[std::size_t(mode)];
      f = of_stress(t);
      f.col(0) += tensor(aux.stress) * m;
    }
    return flux;
  }

  void add_face(const CrackFace& face, bool plus) {
    const auto part = std::size_t(plus ? face.plus_part : face.minus_part);
    const Vec2 along = (face.to - face.from).cwiseProduct(grid_.element_size());
    const Vec2 n = turned_left(along).normalized();
    const double sign = plus ? 1.0 : -1.0;
    const Vec2 shift = 1e-3 * sign * turned_left(face.to - face.from);
    auto places = bases_[part].tip_places();
    places.push_back({grid_.to_grid(domain_.zone.frame.tip()) - corner_, {}});
    for (const auto& point : line_quadrature(face.from - corner_, face.to - corner_, places)) {
      const Vec2 x = grid_.from_grid(corner_ + point.at);
      const double r = domain_.zone.frame.local(x).norm();
      if (r == 0.0) continue;
      const Vec2 inside = point.at + shift;
      bases_[part].evaluate(point.at, functions_, &inside);
      const double angle = domain_.zone.frame.angle(x, domain_.side_of(face, plus));
      add(part, -point.weight * along.norm() * q_.value(point.at),
          flux_out(r, angle, -sign * axes_ * n, true));
    }
  }

  void add_rim(Side side) {
    const SideGeometry geometry = geometry_of(side);
    for (const SidePortion& portion : c_.cuts.side(e_, geometry.element_side)) {
      const auto part = std::size_t(portion.part);
      const Vec2 from = geometry.at(portion.t0), to = geometry.at(portion.t1);
      const double length = (to - from).cwiseProduct(grid_.element_size()).norm();
      for (const auto& point : line_quadrature(from, to, bases_[part].tip_places())) {
        const Vec2 x = grid_.from_grid(corner_ + point.at);
        const double r = domain_.zone.frame.local(x).norm();
        if (r == 0.0) continue;
        bases_[part].evaluate(point.at, functions_);
        add(part, -point.weight * length * q_.value(point.at),
            flux_out(r, domain_.zone.frame.angle(x), axes_ * geometry.outward,
                     !domain_.held_sides[std::size_t(side)]));
      }
    }
  }

  const BasisContext& c_;
  const StructuredGrid& grid_;
  GridIndex e_;
  Vec2 corner_;
  const std::vector<PartBasis>& bases_;
  const IntegralDomain& domain_;
  const Material& material_;
  Eigen::Matrix2d axes_;
  DomainWeight q_;
  std::vector<BasisFunction> functions_;
  ElementWeights sums_;
};

}  // namespace

void IntegralDomain::for_each_element(
    const LocalMesh& mesh, const std::function<void(GridIndex, const DomainWeight&)>& visit) const {
  const StructuredGrid& grid = mesh.grid();
  const Vec2 reach = radius * grid.element_size().cwiseInverse() + Vec2(1, 1);
  const Vec2 centre = grid.to_grid(zone.frame.tip());
  const GridIndex low = grid.element_at(centre - reach), high = grid.element_at(centre + reach);
  for (int j = low.j; j <= high.j; ++j) {
    for (int i = low.i; i <= high.i; ++i) {
      const GridIndex e{i, j};
      if (!mesh.evaluates(e) || mesh.find_element(e) < 0) continue;
      const DomainWeight q(grid, e, zone.frame.tip(), radius);
      if (!q.nothing()) visit(e, q);
    }
  }
}

bool IntegralDomain::on_straight_part(const StructuredGrid& grid, const CrackFace& face) const {
  if (face.crack != zone.crack) return false;
  for (const Vec2& end : {face.from, face.to}) {
    const Vec2 d = zone.frame.local(grid.from_grid(end));
    const double limit = 1e-5 * grid.smallest_side();
    if (std::abs(d.y()) > limit || d.x() > limit) return false;
    if (d.norm() > zone.frame.straight_length() + limit) return false;
  }
  return true;
}

FaceSide IntegralDomain::side_of(const CrackFace& face, bool plus) const {
  if (face.crack != zone.crack) return FaceSide::none;
  // the left of the crack is the left of the way to the tip at end 1, the right at end 0
  return (zone.end == 1) == plus ? FaceSide::plus : FaceSide::minus;
}

Eigen::Matrix2d IntegralDomain::axes() const {
  Eigen::Matrix2d axes;
  axes.row(0) = zone.frame.tangent();
  axes.row(1) = turned_left(zone.frame.tangent());
  return axes;
}

void IntegralDomain::take_off(const Material& material, const Vec2& x, FaceSide side, double w,
                              const Vec2& t, double m[2]) const {
  const double r = zone.frame.local(x).norm();
  if (r == 0.0) return;
  const Vec2 along_tip = axes() * t;
  const double angle = zone.frame.angle(x, side);
  for (int mode = 0; mode < 2; ++mode)
    m[mode] -= w * along_tip.dot(williams_field(material, mode + 1, r, angle).gradient.col(0));
}

void IntegralDomain::for_face_points(
    const StructuredGrid& grid, GridIndex e, const CrackFace& face, bool plus,
    const DomainWeight& q, const std::function<void(const Vec2&, FaceSide, double)>& visit) const {
  const Vec2 corner(e.i, e.j);
  const double length = (face.to - face.from).cwiseProduct(grid.element_size()).norm();
  const SingularPlace tip{grid.to_grid(zone.frame.tip()) - corner, {}};
  for (const auto& point : line_quadrature(face.from - corner, face.to - corner, {tip}))
    visit(grid.from_grid(corner + point.at), side_of(face, plus),
          point.weight * length * q.value(point.at));
}

namespace {

/// What tractions on touching faces count for, in the order of patches.
std::vector<IntensityCache::PatchWeight> weights_of_patches(const BasisContext& c,
                                                            const IntegralDomain& domain,
                                                            const Material& material,
                                                            const ContactPatches& contact) {
  const StructuredGrid& grid = c.mesh.grid();
  std::map<std::size_t, IntensityCache::PatchWeight> found;
  domain.for_each_element(c.mesh, [&](GridIndex e, const DomainWeight& q) {
    for (const CrackFace& face : c.cuts.faces_at(e)) {
      if (!contact.may_touch(face.crack)) continue;
      for (const bool plus : {true, false}) {
        if ((plus ? face.plus_element : face.minus_element) != e) continue;
        domain.for_face_points(grid, e, face, plus, q, [&](const Vec2& x, FaceSide side, double w) {
          const ContactPatch* patch = contact.find(face.crack, face.segment, x);
          if (!patch) return;
          const auto number = std::size_t(patch - contact.patches().data());
          auto& weight = found.try_emplace(number, number).first->second;
          for (int k = 0; k < 2; ++k) {
            double m[2] = {0.0, 0.0};
            domain.take_off(material, x, side, plus ? w : -w, Vec2::Unit(k), m);
            weight.mode_1[k] += m[0];
            weight.mode_2[k] += m[1];
          }
        });
      }
    }
  });
  std::vector<IntensityCache::PatchWeight> weights;
  for (const auto& [number, weight] : found) weights.push_back(weight);
  return weights;
}

}  // namespace

const IntensityCache::OfTip& IntensityCache::of(const BasisContext& c, const IntegralDomain& domain,
                                                const Material& material,
                                                const ContactPatches* contact) {
  const auto [it, is_new] = tips_.try_emplace({domain.zone.crack, domain.zone.end, domain.radius});
  if (!is_new) return it->second;
  if (contact) it->second.patches = weights_of_patches(c, domain, material, *contact);
  std::vector<Weight>& all = it->second.displacements;
  domain.for_each_element(c.mesh, [&](GridIndex e, const DomainWeight&) {
    std::vector<PartBasis> bases;
    for (int part = 0; part < c.cuts.parts(e); ++part) bases.emplace_back(c, e, part);
    const ElementWeights& weights = of(c, e, bases, domain, material);
    for (std::size_t part = 0; part < bases.size(); ++part) {
      Eigen::Index row = 0;
      for (const LocalId first : bases[part].unknowns()) {
        for (LocalId u = first; u < first + 2; ++u, ++row)
          all.push_back({u, weights[part](row, 0), weights[part](row, 1)});
      }
    }
  });
  return it->second;
}

const ElementWeights& IntensityCache::of(const BasisContext& c, GridIndex e,
                                         const std::vector<PartBasis>& bases,
                                         const IntegralDomain& domain, const Material& material) {
  Signature s;
  for (std::size_t part = 0; part < bases.size(); ++part) add_part(c, e, int(part), bases[part], s);
  for (const CrackFace& face : c.cuts.faces_at(e)) {
    for (const Vec2& p : {face.from, face.to}) s.add(p.x()), s.add(p.y());
    const bool plus = face.plus_element == e, minus = face.minus_element == e;
    s.add_bits(std::uint64_t(plus ? face.plus_part + 1 : 0));
    s.add_bits(std::uint64_t(minus ? face.minus_part + 1 : 0));
    s.add_bits(face.crack == domain.zone.crack ? 1 : 0);
  }
  for (const Vec2& p : domain.zone.frame.path()) s.add(p.x()), s.add(p.y());
  s.add_bits(std::uint64_t(domain.zone.end));
  s.add(domain.radius);
  for (const bool held : domain.held_sides) s.add_bits(held ? 1 : 0);
  return weights_.of(s.value(), [&] {
    return std::make_unique<ElementWeights>(ElementSum(c, e, bases, domain, material).weights());
  });
}

}  // namespace cdca
