// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/face_stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

namespace {

/// In element areas.
double area_of(const ElementCuts& cuts, GridIndex element, int part) {
  const CutElement* cut = cuts.find(element);
  if (!cut) return 1.0;
  double area = 0.0;
  for (const ElementPolygon& p : cut->polygons) area += p.part == part ? p.area : 0.0;
  return area;
}

bool has_tip_functions(const StructuredGrid& grid, const std::vector<TipZone>& zones, GridIndex e,
                       int part) {
  for (const TipZone& zone : zones) {
    if (!zone.acts_on(grid.element(e), part)) continue;
    for (const GridIndex n : grid.corners(e)) {
      if (zone.nodes.count(grid.node(n))) return true;
    }
  }
  return false;
}

constexpr double sound_part = 1.0 / 10, near_tip_part = 1.0 / 100;

}  // namespace

FaceGeometry::FaceGeometry(const ElementCuts& cuts, const std::vector<TipZone>& zones,
                           const CrackFace& face, const ElasticMatrix& elastic) {
  const StructuredGrid& grid = cuts.grid();
  const Vec2& h = grid.element_size();
  tangent = face.direction.cwiseProduct(h).normalized();
  normal = turned_left(tangent);
  // round a sliver the face counts as the stretch of crack that it stands for
  length = std::abs((face.to - face.from).cwiseProduct(h).dot(tangent));
  near_tip = has_tip_functions(grid, zones, face.plus_element, face.plus_part) ||
             has_tip_functions(grid, zones, face.minus_element, face.minus_part);
  const double plus = area_of(cuts, face.plus_element, face.plus_part);
  const double minus = area_of(cuts, face.minus_element, face.minus_part);
  plus_share = plus / (plus + minus);
  const double depth =
      std::min(h.minCoeff(), (plus + minus) * h.prod() / std::max(length, 1e-9 * h.minCoeff()));
  compliance = depth * (near_tip ? near_tip_part : sound_part) / elastic(0, 0);
}

SpringTerms::SpringTerms(const FaceGeometry& face, double spring)
    : jump(1 / (1 / spring + face.compliance)),
      mixed(face.near_tip ? 0.0 : face.compliance * jump),
      stress(mixed / spring) {}

Eigen::Matrix2d traction_of(const Vec2& g, const Vec2& n, const ElasticMatrix& d) {
  Eigen::Matrix<double, 3, 2> strain;
  strain << g.x(), 0, 0, g.y(), g.y(), g.x();
  Eigen::Matrix<double, 2, 3> across;
  across << n.x(), 0, n.y(), 0, n.y(), n.x();
  return across * d * strain;
}

void add_springs(const std::vector<FaceFunction>& functions, const FaceGeometry& face,
                 const FaceStretch& springs, double weight, Eigen::Ref<Eigen::MatrixXd> matrix) {
  const auto size = Eigen::Index(2 * functions.size());
  Eigen::VectorXd jump(size), stress(size);
  const std::pair<double, const Vec2*> directions[] = {{springs.normal, &face.normal},
                                                       {springs.tangential, &face.tangent}};
  for (const auto& [spring, direction] : directions) {
    if (spring <= 0.0) continue;
    const SpringTerms terms(face, spring);
    for (std::size_t k = 0; k < functions.size(); ++k) {
      jump.segment<2>(Eigen::Index(2 * k)) = functions[k].jump * *direction;
      stress.segment<2>(Eigen::Index(2 * k)) = functions[k].traction.transpose() * *direction;
    }
    matrix += weight * terms.jump * jump * jump.transpose();
    if (terms.mixed == 0.0) continue;
    const Eigen::VectorXd mix = weight * (terms.mixed * jump - 0.5 * terms.stress * stress);
    matrix += mix * stress.transpose() + stress * mix.transpose();
  }
}

std::array<FacePoint, 3> plain_points(const CrackFace& face, const FaceGeometry& geometry,
                                      double from, double to) {
  const double root = 0.5 * std::sqrt(0.6), length = (to - from) * geometry.length;
  const auto point = [&](double s, double weight) {
    return FacePoint{face.from + (from + s * (to - from)) * (face.to - face.from), weight * length};
  };
  return {point(0.5 - root, 5.0 / 18), point(0.5, 8.0 / 18), point(0.5 + root, 5.0 / 18)};
}

FaceBasis::FaceBasis(const BasisContext& c, const CrackFace& face, const ElasticMatrix& elastic)
    : face_(face),
      plus_corner_(face.plus_element.i, face.plus_element.j),
      minus_corner_(face.minus_element.i, face.minus_element.j),
      elastic_(elastic),
      geometry_(c.cuts, c.zones, face, elastic),
      plus_(c, face.plus_element, face.plus_part),
      minus_(c, face.minus_element, face.minus_part) {}

std::vector<FacePoint> FaceBasis::points(double from, double to) const {
  auto places = plus_.tip_places();
  for (SingularPlace place : minus_.tip_places()) {
    place.at += minus_corner_ - plus_corner_;
    const auto same = [&](const SingularPlace& p) { return (p.at - place.at).norm() < 1e-9; };
    if (std::none_of(places.begin(), places.end(), same)) places.push_back(place);
  }
  if (places.empty()) {
    const auto plain = plain_points(face_, geometry_, from, to);
    return {plain.begin(), plain.end()};
  }
  const Vec2 a = face_.from + from * (face_.to - face_.from);
  const Vec2 b = face_.from + to * (face_.to - face_.from);
  std::vector<FacePoint> points;
  for (const QuadraturePoint& q : line_quadrature(a - plus_corner_, b - plus_corner_, places))
    points.push_back({plus_corner_ + q.at, q.weight * (to - from) * geometry_.length});
  return points;
}

void FaceBasis::evaluate(const Vec2& at, std::vector<FaceFunction>& functions) const {
  const Vec2 across = 1e-3 * turned_left(face_.to - face_.from);
  functions.clear();
  const auto add = [&](const PartBasis& basis, const Vec2& p, const Vec2& inside, double sign,
                       double share) {
    basis.evaluate(p, side_, &inside);
    for (const BasisFunction& f : side_) {
      auto known = std::find_if(functions.begin(), functions.end(),
                                [&](const FaceFunction& g) { return g.unknown == f.unknown; });
      if (known == functions.end()) known = functions.insert(known, FaceFunction{f.unknown});
      known->jump += sign * f.value;
      if (!geometry_.near_tip)
        known->traction += share * traction_of(f.gradient, geometry_.normal, elastic_);
    }
  };
  const Vec2 p = at - plus_corner_, m = at - minus_corner_;
  add(plus_, p, p + across, 1.0, geometry_.plus_share);
  add(minus_, m, m - across, -1.0, 1 - geometry_.plus_share);
}

FaceBasis::Field FaceBasis::field(const std::vector<FaceFunction>& functions,
                                  std::span<const double> state) const {
  Vec2 jump(0, 0), traction(0, 0);
  for (const FaceFunction& f : functions) {
    const Vec2 u(state[std::size_t(f.unknown)], state[std::size_t(f.unknown) + 1]);
    jump += f.jump * u;
    traction += f.traction * u;
  }
  const auto turned = [&](const Vec2& v) {
    return Vec2(v.dot(geometry_.tangent), v.dot(geometry_.normal));
  };
  return {turned(jump), turned(traction)};
}

PartStiffness face_stiffness(const BasisContext& context, const CrackFace& face,
                             const ElasticMatrix& elastic,
                             const std::vector<FaceStretch>& springs) {
  const FaceBasis basis(context, face, elastic);
  PartStiffness stiffness;
  std::vector<FaceFunction> functions;
  for (const FaceStretch& s : springs) {
    for (const FacePoint& p : basis.points(s.from, s.to)) {
      basis.evaluate(p.at, functions);
      if (stiffness.unknowns.empty()) {
        for (const FaceFunction& f : functions)
          stiffness.unknowns.insert(stiffness.unknowns.end(), {f.unknown, f.unknown + 1});
        const auto size = Eigen::Index(2 * functions.size());
        stiffness.matrix = Eigen::MatrixXd::Zero(size, size);
      }
      add_springs(functions, basis.geometry(), s, p.weight, stiffness.matrix);
    }
  }
  return stiffness;
}

}  // namespace cdca
