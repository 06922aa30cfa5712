// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/interaction_integral.hpp"

#include "core/base/first_failure.hpp"
#include "core/cells/tip_quadrature.hpp"
#include "core/mechanics/contact_patches.hpp"
#include "core/mechanics/domain_weight.hpp"
#include "core/mechanics/side_walk.hpp"
#include "core/mechanics/williams.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace cdca {

namespace {

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

/// Sums of one tip.
class TipIntegral {
 public:
  TipIntegral(const BasisContext& c, const IntegralDomain& domain, const Material& material,
              const ExternalLoads& loads)
      : c_(c), grid_(c.mesh.grid()), domain_(domain), material_(material), loads_(loads) {}

  /// Adds the share of this rank: m[0] for mode I, m[1] for mode II.
  void add(std::span<const double> state, IntensityCache& cache, double m[2]) {
    const auto& weights = cache.of(c_, domain_, material_, loads_.contact);
    for (const auto& [unknown, mode_1, mode_2] : weights.displacements) {
      m[0] += mode_1 * state[std::size_t(unknown)];
      m[1] += mode_2 * state[std::size_t(unknown)];
    }
    for (const auto& [patch, mode_1, mode_2] : weights.patches) {
      const Vec2 t = loads_.contact->on_plus(loads_.contact->patches()[patch]);
      m[0] += mode_1.dot(t);
      m[1] += mode_2.dot(t);
    }
    if (!loads_.body && loads_.faces.empty() && loads_.tractions.empty()) return;
    domain_.for_each_element(c_.mesh, [&](GridIndex e, const DomainWeight& q) {
      add_body_force(e, q, m);
      add_face_loads(e, q, m);
      for (const Side side : sides_at(grid_, e)) add_side_tractions(e, side, q, m);
    });
  }

 private:
  void take_off(const Vec2& x, FaceSide side, double w, const Vec2& t, double m[2]) const {
    domain_.take_off(material_, x, side, w, t, m);
  }

  void add_body_force(GridIndex e, const DomainWeight& q, double m[2]) const {
    if (!loads_.body) return;
    for (int part = 0; part < c_.cuts.parts(e); ++part) {
      for (const QuadraturePoint& point : tip_quadrature(c_.cuts.find(e), part, {tip_in(e)},
                                                         grid_.element_size(), orders_of_loads)) {
        const Vec2 x = grid_.from_grid(Vec2(e.i, e.j) + point.at);
        const double w = point.weight * grid_.element_size().prod() * q.value(point.at);
        take_off(x, FaceSide::none, w, loads_.body(x), m);
      }
    }
  }

  void add_face_loads(GridIndex e, const DomainWeight& q, double m[2]) const {
    if (loads_.faces.empty()) return;
    for (const CrackFace& face : c_.cuts.faces_at(e)) {
      for (const FaceLoad& load : loads_.faces) {
        if (load.crack != face.crack) continue;
        for (const bool plus : {true, false}) {
          if ((plus ? face.plus_element : face.minus_element) != e) continue;
          const Vec2 along = (face.to - face.from).cwiseProduct(grid_.element_size());
          const Vec2 n = turned_left(along).normalized();
          domain_.for_face_points(grid_, e, face, plus, q,
                                  [&](const Vec2& x, FaceSide side, double w) {
                                    take_off(x, side, plus ? w : -w, load.on_plus(x, n), m);
                                  });
        }
      }
    }
  }

  void add_side_tractions(GridIndex e, Side side, const DomainWeight& q, double m[2]) const {
    if (loads_.held_sides[std::size_t(side)]) return;
    const SideGeometry geometry = geometry_of(side);
    const Vec2 from = geometry.at(0.0), to = geometry.at(1.0);
    const double length = (to - from).cwiseProduct(grid_.element_size()).norm();
    for (const auto& load : loads_.tractions) {
      if (load.side != side) continue;
      for (const QuadraturePoint& point : line_quadrature(from, to, {tip_in(e)})) {
        const Vec2 x = grid_.from_grid(Vec2(e.i, e.j) + point.at);
        const double w = point.weight * length * q.value(point.at);
        take_off(x, FaceSide::none, w, load.value(x), m);
      }
    }
  }

  SingularPlace tip_in(GridIndex e) const {
    return {grid_.to_grid(domain_.zone.frame.tip()) - Vec2(e.i, e.j), {}};
  }

  const BasisContext& c_;
  const StructuredGrid& grid_;
  const IntegralDomain& domain_;
  const Material& material_;
  const ExternalLoads& loads_;
};

/// The faces behind a tip: those of its group of patches between the bodies that end at the tip.
/// Beyond a fragment the gap tells where that has gone, and nothing about the tip.
struct FacesAtTip {
  double length = 0.0;  ///< m
  double closed = 0.0;  ///< m of it
  double gap = 0.0;     ///< mean, m
};

/// Where the faces touch at the tip.
std::optional<FacesAtTip> touching_faces(const ExternalLoads& loads,
                                         const std::vector<Crack>& cracks, const TipZone& zone) {
  if (!loads.contact) return std::nullopt;
  const Crack& crack = cracks[std::size_t(zone.crack)];
  const int segment = zone.end == 0 ? 0 : int(crack.segments()) - 1;
  const ContactPatch* tip = loads.contact->find(zone.crack, segment, crack.end_point(zone.end));
  if (!tip) return std::nullopt;
  FacesAtTip faces;
  for (const ContactPatch& patch : loads.contact->patches()) {
    if (patch.group != tip->group || patch.bodies != tip->bodies) continue;
    faces.length += patch.length;
    if (patch.now.state != ContactState::open) faces.closed += patch.length;
    faces.gap += patch.length * patch.gap.normal;
  }
  if (faces.closed <= 0.5 * faces.length) return std::nullopt;
  faces.gap /= faces.length;
  return faces;
}

/// K_I that opens the faces at the tip by their mean gap: g(r) = 8 K_I / E' sqrt(r / 2 pi).
double fitted_opening(const FacesAtTip& faces, const Material& material) {
  return 3.0 / 16 * faces.gap * material.fracture_modulus() *
         std::sqrt(2 * std::numbers::pi / faces.length);
}

}  // namespace

std::vector<StressIntensity> stress_intensities(
    const BasisContext& context, const std::vector<Crack>& cracks, const Material& material,
    const ExternalLoads& loads, std::span<const double> state, Communicator& communicator,
    IntensityCache& cache, const TipChoice& wanted, const DomainReach& reach) {
  const StructuredGrid& grid = context.mesh.grid();
  const double h = grid.element_size().maxCoeff();
  std::vector<StressIntensity> found;
  std::vector<const TipZone*> zones;
  for (const TipZone& zone : context.zones) {
    if (!zone.is_active || (wanted && !wanted(zone.crack, zone.end))) continue;
    zones.push_back(&zone);
    const double room = free_radius(grid, cracks, zone);
    const double radius = std::max(std::min(reach.wanted * h, room), reach.smallest * h);
    found.push_back({zone.crack, zone.end, 0.0, 0.0, radius});
  }
  std::vector<double> sums(2 * zones.size(), 0.0);
  fail_together(communicator, [&] {
    // a load may have no value at some place that only one rank asks for
    for (std::size_t z = 0; z < zones.size(); ++z) {
      const IntegralDomain domain{*zones[z], found[z].radius, loads.held_sides};
      TipIntegral(context, domain, material, loads).add(state, cache, &sums[2 * z]);
    }
  });
  communicator.sum(std::span<double>(sums));
  for (std::size_t z = 0; z < found.size(); ++z) {
    found[z].k1 = 0.5 * material.fracture_modulus() * sums[2 * z];
    found[z].k2 = 0.5 * material.fracture_modulus() * sums[2 * z + 1];
    if (const auto faces = touching_faces(loads, cracks, *zones[z])) {
      found[z].k1 = fitted_opening(*faces, material);
      found[z].k1_fitted = true;
    }
  }
  return found;
}

}  // namespace cdca
