// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/reference_plane.hpp"

#include "core/simulation/drawing.hpp"

#include <Eigen/LU>

#include <numbers>

namespace cdca::testing {

namespace {

Field uniform(const Material& material, const Voigt& stress) {
  const Voigt e = material.elastic_matrix().inverse() * stress;  // the last one is 2 eps_xy
  Eigen::Matrix2d strain;
  strain << e[0], e[2] / 2, e[2] / 2, e[1];
  return [strain](const Vec2& x) { return Vec2(strain * x); };
}

}  // namespace

Field sloping_tension(const Material& material, double slope) {
  const Voigt e = material.elastic_matrix().inverse() * Voigt(0, slope, 0);  // at x = 1
  return [e](const Vec2& x) {
    return Vec2(0.5 * (e[0] * x.x() * x.x() - e[1] * x.y() * x.y()), e[1] * x.x() * x.y());
  };
}

PlaneRim::PlaneRim(const Material& material, const Voigt& far_stress)
    : PlaneRim(material, uniform(material, far_stress)) {}

PlaneRim::PlaneRim(const Material& material, Field far)
    : poisson_((3 - material.kolosov()) / 4), far_(std::move(far)) {}

void PlaneRim::hold(CaseSpec& spec) const {
  hold_rim(spec, [this](const Vec2& x) { return displacement(x); });
}

void PlaneRim::take_jumps(const Model& model) {
  const CrackPart faces = draw_cracks(model);
  std::vector<Jump> jumps;
  for (std::size_t k = 0; k < faces.crack.size(); ++k) {
    const Vec2 from(faces.points[4 * k], faces.points[4 * k + 1]);
    const Vec2 to(faces.points[4 * k + 2], faces.points[4 * k + 3]);
    const Vec2 along = (to - from).normalized(), normal = turned_left(along);
    const double opening = 0.5 * (faces.opening[2 * k] + faces.opening[2 * k + 1]);
    const double slip = 0.5 * (faces.slip[2 * k] + faces.slip[2 * k + 1]);
    jumps.push_back(
        {0.5 * (from + to), (to - from).norm() * normal, opening * normal + slip * along});
  }
  relax(std::move(jumps));
}

void PlaneRim::relax(std::vector<Jump> solved) {
  if (jumps_.empty()) {  // the first rim was that of a plane without cracks
    jumps_ = solved;
    for (Jump& j : jumps_) j.jump.setZero();
  }
  std::vector<Vec2> change(solved.size());
  double along = 0.0, square = 0.0;
  for (std::size_t k = 0; k < solved.size(); ++k) {
    change[k] = solved[k].jump - jumps_[k].jump;
    if (change_.empty()) continue;
    const Vec2 difference = change[k] - change_[k];
    along += change_[k].dot(difference);
    square += difference.squaredNorm();
  }
  if (square > 0.0) relaxation_ *= -along / square;
  for (std::size_t k = 0; k < solved.size(); ++k) jumps_[k].jump += relaxation_ * change[k];
  change_ = std::move(change);
}

Vec2 PlaneRim::displacement(const Vec2& x) const {
  Vec2 u = far_(x);
  for (const Jump& j : jumps_) {
    const double r = (j.at - x).norm();
    const Vec2 d = (j.at - x) / r;
    // [u]_i S_ijk n_j with S_ijk = -((1 - 2 nu)(D_ik d_j + D_jk d_i - D_ij d_k) + 2 d_i d_j d_k)
    //                              / (4 pi (1 - nu) r)
    const double dn = d.dot(j.normal), dj = d.dot(j.jump);
    const Vec2 sum = (1 - 2 * poisson_) * (dn * j.jump + dj * j.normal - j.jump.dot(j.normal) * d) +
                     2 * dj * dn * d;
    u -= sum / (4 * std::numbers::pi * (1 - poisson_) * r);
  }
  return u;
}

}  // namespace cdca::testing
