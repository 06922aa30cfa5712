// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/interaction_integral.hpp"

#include "core/cells/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cdca {

namespace {

constexpr double wanted_radius = 5.0;    ///< element sizes
constexpr double smallest_radius = 2.0;  ///< element sizes

/// The weight q of the domain and its slope.
struct Plateau {
  double radius;
  double value(double r) const {
    const double x = std::clamp(2 * r / radius - 1, 0.0, 1.0);
    return 1 - x * x * x * (10 - 15 * x + 6 * x * x);
  }
  double slope(double r) const {
    const double x = std::clamp(2 * r / radius - 1, 0.0, 1.0);
    return -30 * x * x * (1 - x) * (1 - x) * 2 / radius;
  }
};

double distance_to_segment(const Vec2& a, const Vec2& b, const Vec2& x) {
  return (a + nearest_fraction(a, b, x) * (b - a) - x).norm();
}

/// How far the domain of a tip may reach.
double free_radius(const StructuredGrid& grid, const std::vector<Crack>& cracks,
                   const TipZone& zone) {
  const Vec2 x = zone.frame.tip();
  const Vec2 low = x - grid.origin(), high = grid.origin() + grid.size() - x;
  const Crack& own = cracks[std::size_t(zone.crack)];
  const bool straight_to_rim =
      own.segments() == 1 && own.ends[std::size_t(1 - zone.end)].state == TipState::boundary;
  double r = straight_to_rim ? 1e300 : zone.frame.straight_length();
  r = std::min({r, low.minCoeff(), high.minCoeff()});
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    if (int(c) == zone.crack) continue;
    for (std::size_t k = 0; k < cracks[c].segments(); ++k) {
      r = std::min(r, distance_to_segment(cracks[c].points[k], cracks[c].points[k + 1], x));
    }
  }
  return 0.999 * r;
}

/// Sums of one tip, in its own axes.
class TipIntegral {
 public:
  TipIntegral(const BasisContext& c, const TipZone& zone, const Material& material,
              const ExternalLoads& loads, std::span<const double> state, double radius)
      : c_(c), zone_(zone), material_(material), loads_(loads), state_(state), q_{radius} {
    axes_.row(0) = zone.frame.tangent();
    axes_.row(1) = turned_left(zone.frame.tangent());
  }

  /// Adds the share of this rank: m[0] for mode I, m[1] for mode II.
  void add(double m[2]) {
    const StructuredGrid& grid = c_.mesh.grid();
    const Vec2 reach = q_.radius * grid.element_size().cwiseInverse();
    const Vec2 centre = grid.to_grid(zone_.frame.tip());
    const GridIndex low = grid.element_at(centre - reach), high = grid.element_at(centre + reach);
    for (int j = low.j; j <= high.j; ++j) {
      for (int i = low.i; i <= high.i; ++i) {
        const GridIndex e{i, j};
        if (!c_.mesh.evaluates(e) || c_.mesh.find_element(e) < 0) continue;
        for (int part = 0; part < c_.cuts.parts(e); ++part) add_part(e, part, m);
        add_faces(e, m);
      }
    }
  }

 private:
  void add_part(GridIndex e, int part, double m[2]) {
    const StructuredGrid& grid = c_.mesh.grid();
    const PartBasis basis(c_, e, part);
    const CutElement* cut = c_.cuts.find(e);
    const auto points = basis.has_tip_functions()
                            ? tip_quadrature(cut, part, basis.tip_places(), grid.element_size())
                            : smooth_quadrature(cut, part, 6);
    for (const QuadraturePoint& point : points) {
      const Vec2 x = grid.from_grid(Vec2(e.i, e.j) + point.at);
      const Vec2 d = zone_.frame.local(x);
      const double r = d.norm(), w = point.weight * grid.element_size().prod();
      if (r >= q_.radius || r == 0.0) continue;
      const Vec2 dq = q_.slope(r) / r * d;
      const bool flat = dq.isZero(0.0);
      if (flat && !loads_.body) continue;
      Voigt s = Voigt::Zero();
      Eigen::Matrix2d g = Eigen::Matrix2d::Zero();
      if (!flat) {
        basis.evaluate(point.at, functions_);
        g = axes_ * field_value(functions_, state_).gradient * axes_.transpose();
        s = material_.stress(g);
      }
      for (int mode = 0; mode < 2; ++mode) {
        const WilliamsField aux = williams_field(material_, mode + 1, r, std::atan2(d.y(), d.x()));
        if (!flat) m[mode] += w * domain_term(s, g, aux, dq);
        if (loads_.body)
          m[mode] -= w * q_.value(r) * (axes_ * loads_.body(x)).dot(aux.gradient.col(0));
      }
    }
  }

  /// (s_ij u'_i,1 + s'_ij u_i,1 - s_ij e'_ij d_1j) q,_j
  static double domain_term(const Voigt& s, const Eigen::Matrix2d& g, const WilliamsField& aux,
                            const Vec2& dq) {
    Eigen::Matrix2d sigma, sigma_aux;
    sigma << s[0], s[2], s[2], s[1];
    sigma_aux << aux.stress[0], aux.stress[2], aux.stress[2], aux.stress[1];
    const Vec2 flux = sigma * aux.gradient.col(0) + sigma_aux * g.col(0);
    return flux.dot(dq) - sigma.cwiseProduct(aux.gradient).sum() * dq.x();
  }

  void add_faces(GridIndex e, double m[2]) {
    const StructuredGrid& grid = c_.mesh.grid();
    const Vec2 tip = grid.to_grid(zone_.frame.tip());
    for (const CrackFace& face : c_.cuts.faces_of(e)) {
      for (const FaceLoad& load : loads_.faces) {
        if (load.crack != face.crack || face.crack != zone_.crack) continue;
        const Vec2 along = (face.to - face.from).cwiseProduct(grid.element_size());
        const Vec2 n = turned_left(along).normalized();
        // the left of the crack is the left of the way to the tip at end 1, the right at end 0
        const double plus_angle = zone_.end == 1 ? std::numbers::pi : -std::numbers::pi;
        for (const QuadraturePoint& point : line_quadrature(face.from, face.to, {{tip, {}}})) {
          const Vec2 x = grid.from_grid(point.at);
          const double r = zone_.frame.local(x).norm();
          if (r >= q_.radius || r == 0.0) continue;
          const Vec2 t = axes_ * load.on_plus(x, n);
          for (int mode = 0; mode < 2; ++mode) {
            const auto plus = williams_field(material_, mode + 1, r, plus_angle);
            const auto minus = williams_field(material_, mode + 1, r, -plus_angle);
            m[mode] -= point.weight * along.norm() * q_.value(r) *
                       t.dot(plus.gradient.col(0) - minus.gradient.col(0));
          }
        }
      }
    }
  }

  const BasisContext& c_;
  const TipZone& zone_;
  const Material& material_;
  const ExternalLoads& loads_;
  std::span<const double> state_;
  Plateau q_;
  Eigen::Matrix2d axes_;
  std::vector<BasisFunction> functions_;
};

}  // namespace

WilliamsField williams_field(const Material& material, int mode, double r, double theta) {
  const double kappa = material.kolosov(), mu = material.shear();
  const double c = std::cos(theta / 2), s = std::sin(theta / 2);
  const double c3 = std::cos(1.5 * theta), s3 = std::sin(1.5 * theta);
  const double amplitude = std::sqrt(r / (2 * std::numbers::pi)) / (2 * mu);
  // u = amplitude f(theta), f' its derivative
  Vec2 f, df;
  WilliamsField field;
  const double root = 1 / std::sqrt(2 * std::numbers::pi * r);
  if (mode == 1) {
    f = {(kappa - 0.5) * c - 0.5 * c3, (kappa + 0.5) * s - 0.5 * s3};
    df = {-0.5 * (kappa - 0.5) * s + 0.75 * s3, 0.5 * (kappa + 0.5) * c - 0.75 * c3};
    field.stress = root * Voigt(c * (1 - s * s3), c * (1 + s * s3), c * s * c3);
  } else {
    f = {(kappa + 1.5) * s + 0.5 * s3, -(kappa - 1.5) * c - 0.5 * c3};
    df = {0.5 * (kappa + 1.5) * c + 0.75 * c3, 0.5 * (kappa - 1.5) * s + 0.75 * s3};
    field.stress = root * Voigt(-s * (2 + c * c3), s * c * c3, c * (1 - s * s3));
  }
  const Vec2 radial(std::cos(theta), std::sin(theta));
  field.displacement = amplitude * f;
  field.gradient =
      amplitude / r * (0.5 * f * radial.transpose() + df * turned_left(radial).transpose());
  return field;
}

std::vector<StressIntensity> stress_intensities(
    const BasisContext& context, const std::vector<Crack>& cracks, const Material& material,
    const ExternalLoads& loads, std::span<const double> state, Communicator& communicator) {
  const StructuredGrid& grid = context.mesh.grid();
  const double h = grid.element_size().maxCoeff();
  std::vector<double> sums(2 * context.zones.size(), 0.0);
  std::vector<StressIntensity> found;
  for (std::size_t z = 0; z < context.zones.size(); ++z) {
    const TipZone& zone = context.zones[z];
    const double room = free_radius(grid, cracks, zone);
    const double radius = std::max(std::min(wanted_radius * h, room), smallest_radius * h);
    TipIntegral(context, zone, material, loads, state, radius).add(&sums[2 * z]);
    found.push_back({zone.crack, zone.end, 0.0, 0.0, radius});
  }
  communicator.sum(std::span<double>(sums));
  for (std::size_t z = 0; z < found.size(); ++z) {
    found[z].k1 = 0.5 * material.fracture_modulus() * sums[2 * z];
    found[z].k2 = 0.5 * material.fracture_modulus() * sums[2 * z + 1];
  }
  return found;
}

}  // namespace cdca
