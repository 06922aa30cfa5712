// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/face_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Of all faces inside the element that bound the part, m.
double face_length_at(const CutElement& cut, int part, const Vec2& h) {
  double length = 0.0;
  for (const InnerFace& f : cut.faces) {
    if (f.plus == part || f.minus == part) length += (f.to - f.from).cwiseProduct(h).norm();
  }
  return length;
}

/// Parts of an element whose compliance is S.
constexpr double with_stress = 1.0 / 5, near_tips = 1.0 / 10;

}  // namespace

FaceGeometry::FaceGeometry(const ElementCuts& cuts, const CrackFace& face,
                           const ElasticMatrix& elastic) {
  const Vec2& h = cuts.grid().element_size();
  tangent = face.direction.cwiseProduct(h).normalized();
  normal = turned_left(tangent);
  // round a sliver the face counts as the stretch of crack that it stands for
  length = std::abs((face.to - face.from).cwiseProduct(h).dot(tangent));
  uses_stress = face.plus_element == face.minus_element;
  const double plus = area_of(cuts, face.plus_element, face.plus_part);
  const double minus = area_of(cuts, face.minus_element, face.minus_part);
  plus_share = plus / (plus + minus);
  // all faces of a part share its stiffness
  double shared = length;
  if (const CutElement* cut = cuts.find(face.plus_element); cut && uses_stress)
    shared = std::max({length, face_length_at(*cut, face.plus_part, h),
                       face_length_at(*cut, face.minus_part, h)});
  depth = std::min(h.minCoeff(), (plus + minus) * h.prod() / std::max(shared, 1e-9 * h.minCoeff()));
  compliance = uses_stress ? with_stress * depth / elastic(0, 0) : 0.0;
}

FaceSpot::Field FaceSpot::field(const FaceGeometry& face, std::span<const double> state) const {
  Vec2 jump(0, 0), traction(0, 0);
  for (const FaceFunction& f : functions) {
    const Vec2 u(state[std::size_t(f.unknown)], state[std::size_t(f.unknown) + 1]);
    jump += f.jump * u;
    traction += f.traction * u;
  }
  const auto turned = [&](const Vec2& v) { return Vec2(v.dot(face.tangent), v.dot(face.normal)); };
  return {turned(jump), turned(traction)};
}

SpringTerms::SpringTerms(const FaceGeometry& face, double compliance, double spring) {
  if (spring > 0.0) {
    jump = 1 / (1 / spring + compliance);
    if (!face.uses_stress) return;
    mixed = compliance * jump;
    stress = mixed / spring;
  } else if (face.uses_stress) {
    stress = compliance;
  }
}

Eigen::Matrix2d traction_of(const Vec2& g, const Vec2& n, const ElasticMatrix& d) {
  Eigen::Matrix<double, 3, 2> strain;
  strain << g.x(), 0, 0, g.y(), g.y(), g.x();
  Eigen::Matrix<double, 2, 3> across;
  across << n.x(), 0, n.y(), 0, n.y(), n.x();
  return across * d * strain;
}

SpotForms::SpotForms(const FaceSpot& spot, const FaceGeometry& face)
    : face_(face),
      weight_(spot.weight),
      compliance_(spot.compliance),
      effects_(2 * Eigen::Index(spot.functions.size()), 4) {
  for (std::size_t k = 0; k < spot.functions.size(); ++k) {
    const FaceFunction& f = spot.functions[k];
    auto own = effects_.middleRows<2>(Eigen::Index(2 * k));
    own.col(0) = f.jump.transpose() * face.normal;
    own.col(1) = f.traction.transpose() * face.normal;
    own.col(2) = f.jump.transpose() * face.tangent;
    own.col(3) = f.traction.transpose() * face.tangent;
  }
}

void SpotForms::add_springs(const FaceStretch& springs, Eigen::Ref<Eigen::MatrixXd> matrix) const {
  Eigen::Matrix4d form = Eigen::Matrix4d::Zero();
  for (int d = 0; d < 2; ++d) {
    const SpringTerms terms(face_, compliance_, d == 0 ? springs.normal : springs.tangential);
    form.block<2, 2>(2 * d, 2 * d) << terms.jump, terms.mixed, terms.mixed, -terms.stress;
  }
  const Eigen::MatrixXd weighted = effects_ * (weight_ * form);
  matrix.noalias() += weighted * effects_.transpose();
}

std::vector<FacePoint> plain_points(const CrackFace& face, const FaceGeometry& geometry,
                                    double from, double to) {
  const double share = to - from, length = share * geometry.length;
  if (!geometry.uses_stress) return {{from + to < 1 ? face.from : face.to, length}};
  const double root = 0.5 / std::sqrt(3.0);
  const auto point = [&](double s) {
    return FacePoint{face.from + (from + s * share) * (face.to - face.from), 0.5 * length};
  };
  return {point(0.5 - root), point(0.5 + root)};
}

FaceBasis::FaceBasis(const BasisContext& c, const CrackFace& face, const ElasticMatrix& elastic)
    : face_(face),
      size_(c.mesh.grid().element_size()),
      plus_corner_(face.plus_element.i, face.plus_element.j),
      minus_corner_(face.minus_element.i, face.minus_element.j),
      elastic_(elastic),
      geometry_(c.cuts, face, elastic),
      plus_(c, face.plus_element, face.plus_part),
      minus_(c, face.minus_element, face.minus_part) {}

std::vector<SingularPlace> FaceBasis::tip_places() const {
  auto places = plus_.tip_places();
  for (SingularPlace place : minus_.tip_places()) {
    place.at += minus_corner_ - plus_corner_;
    const auto same = [&](const SingularPlace& p) { return (p.at - place.at).norm() < 1e-9; };
    if (std::none_of(places.begin(), places.end(), same)) places.push_back(place);
  }
  return places;
}

std::vector<FacePoint> FaceBasis::points(double from, double to,
                                         const std::vector<SingularPlace>& tips) const {
  if (tips.empty()) return plain_points(face_, geometry_, from, to);
  if (!geometry_.uses_stress) {
    // at a tip there is no jump: the middle of the stretch stands for it
    auto nodes = plain_points(face_, geometry_, from, to);
    for (FacePoint& p : nodes) {
      for (const SingularPlace& tip : tips) {
        if ((p.at - plus_corner_ - tip.at).norm() < 1e-6)
          p.at = face_.from + 0.5 * (from + to) * (face_.to - face_.from);
      }
    }
    return nodes;
  }
  const Vec2 a = face_.from + from * (face_.to - face_.from) - plus_corner_;
  const Vec2 b = face_.from + to * (face_.to - face_.from) - plus_corner_;
  std::vector<FacePoint> graded;
  for (const QuadraturePoint& q : line_quadrature(a, b, tips))
    graded.push_back({plus_corner_ + q.at, q.weight * (to - from) * geometry_.length});
  return graded;
}

double FaceBasis::compliance_at(const Vec2& at, const std::vector<SingularPlace>& tips) const {
  if (tips.empty() || !geometry_.uses_stress) return geometry_.compliance;
  double r = std::numeric_limits<double>::infinity();
  for (const SingularPlace& tip : tips)
    r = std::min(r, (at - plus_corner_ - tip.at).cwiseProduct(size_).norm());
  return geometry_.compliance * near_tips * std::min(1.0, r / geometry_.depth);
}

FaceSpot FaceBasis::spot(double from, double to) const {
  const auto tips = tip_places();
  const auto places = points(from, to, tips);
  FaceSpot spot;
  for (const FacePoint& p : places) spot.weight += p.weight;
  for (const FacePoint& p : places) {
    // a face round a sliver may stand for no length at all
    const double share = spot.weight > 0.0 ? p.weight / spot.weight : 1.0 / double(places.size());
    spot.compliance += share * compliance_at(p.at, tips);
    add_functions(p, share, spot);
  }
  return spot;
}

void FaceBasis::add_functions(const FacePoint& point, double share, FaceSpot& spot) const {
  const Vec2 across = 1e-3 * turned_left(face_.to - face_.from);
  const auto add = [&](const PartBasis& basis, const Vec2& p, const Vec2& inside, double sign,
                       double side_share) {
    basis.evaluate(p, side_, &inside);
    for (const BasisFunction& f : side_) {
      auto known = std::find_if(spot.functions.begin(), spot.functions.end(),
                                [&](const FaceFunction& g) { return g.unknown == f.unknown; });
      if (known == spot.functions.end())
        known = spot.functions.insert(known, FaceFunction{f.unknown});
      const Eigen::Matrix2d turn = f.columns();
      known->jump += sign * share * f.value * turn;
      if (geometry_.uses_stress)
        known->traction +=
            share * side_share * traction_of(f.gradient, geometry_.normal, elastic_) * turn;
    }
  };
  const Vec2 p = point.at - plus_corner_, m = point.at - minus_corner_;
  add(plus_, p, p + across, 1.0, geometry_.plus_share);
  add(minus_, m, m - across, -1.0, 1 - geometry_.plus_share);
}

FaceSpots::FaceSpots(const BasisContext& context, const CrackFace& face,
                     const ElasticMatrix& elastic, const std::vector<FaceStretch>& stretches) {
  const FaceBasis basis(context, face, elastic);
  std::vector<FaceSpot> spots;
  for (const FaceStretch& s : stretches) spots.push_back(basis.spot(s.from, s.to));
  if (spots.empty()) return;
  // functions of cells off the grid line that a face lies on do not show on it
  for (std::size_t f = spots.front().functions.size(); f-- > 0;) {
    const auto at = [f](FaceSpot& s) { return s.functions.begin() + std::ptrdiff_t(f); };
    const bool shows = basis.geometry().uses_stress ||
                       std::any_of(spots.begin(), spots.end(),
                                   [&](FaceSpot& s) { return !at(s)->jump.isZero(0.0); });
    if (shows) continue;
    for (FaceSpot& s : spots) s.functions.erase(at(s));
  }
  for (const FaceFunction& f : spots.front().functions)
    stiffness_.unknowns.insert(stiffness_.unknowns.end(), {f.unknown, f.unknown + 1});
  for (const FaceSpot& spot : spots) forms_.emplace_back(spot, basis.geometry());
}

const PartStiffness& FaceSpots::stiffness(const std::vector<FaceStretch>& springs) {
  if (forms_.empty() || springs == springs_) return stiffness_;
  const auto size = Eigen::Index(stiffness_.unknowns.size());
  stiffness_.matrix.setZero(size, size);
  for (std::size_t k = 0; k < forms_.size(); ++k)
    forms_[k].add_springs(springs[k], stiffness_.matrix);
  springs_ = springs;
  return stiffness_;
}

}  // namespace cdca
