// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/body_at_faces.hpp"

#include "core/base/errors.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace cdca {

BodyAtFaces::BodyAtFaces(const std::vector<SpringPlace>& places, const Eigen::MatrixXd& compliance,
                         const std::vector<ContactGap>& closed, Communicator& communicator)
    : places_(places), compliance_(compliance), closed_(closed), communicator_(communicator) {}

std::vector<ContactGap> BodyAtFaces::gaps(const std::vector<ContactAnswer>& answers) {
  Bytes bytes;
  if (communicator_.rank() == 0) pack(bytes, std::span<const ContactGap>(found(answers)));
  communicator_.broadcast(bytes);
  if (bytes.empty() && !closed_.empty())
    throw SolveError("springs of crack faces hold the body too weakly for a factor.");
  return unpack<ContactGap>(bytes);
}

bool BodyAtFaces::set_springs(const Eigen::VectorXd& springs) {
  if (springs_.size() == springs.size() && springs_ == springs) return true;
  roots_.resize(springs.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const SpringPlace& place = places_[k];
    const double missing = place.with_body(place.stiffness) - springs[Eigen::Index(k)];
    roots_[Eigen::Index(k)] = std::sqrt(place.length * std::max(0.0, missing));
  }
  // I - r C r for r^2 = w (k0 - k)
  Eigen::MatrixXd matrix = -(roots_.asDiagonal() * compliance_ * roots_.asDiagonal());
  matrix.diagonal().array() += 1.0;
  const bool factored = factor_.compute(std::move(matrix));
  springs_ = factored ? springs : Eigen::VectorXd();
  return factored;
}

std::vector<ContactGap> BodyAtFaces::found(const std::vector<ContactAnswer>& answers) {
  const auto count = Eigen::Index(places_.size());
  Eigen::VectorXd springs(count), zeros(count), gaps(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const SpringPlace& place = places_[std::size_t(k)];
    const ContactAnswer& answer = answers[place.patch];
    const ContactGap& closed = closed_[place.patch];
    const double scale = 1 + place.compliance * place.stiffness;
    springs[k] = place.with_body(place.axis == 1 ? answer.normal_spring : answer.tangential_spring);
    zeros[k] =
        place.length * springs[k] * (place.axis == 1 ? answer.normal_zero : answer.tangential_zero);
    gaps[k] = scale * (place.axis == 1 ? closed.normal : closed.tangential);
  }
  if (!set_springs(springs)) return {};
  gaps.noalias() += compliance_.selfadjointView<Eigen::Lower>() * zeros;
  // e = r g with (I - r C r) e = r (G u0 + C w k z)
  Eigen::VectorXd scaled = roots_.cwiseProduct(gaps);
  factor_.solve(scaled);
  const Eigen::VectorXd missing = roots_.cwiseProduct(scaled);
  for (Eigen::Index k = 0; k < count; ++k) {
    if (roots_[k] > 0.0) {
      gaps[k] = scaled[k] / roots_[k];
    } else {
      gaps[k] += compliance_.col(k).dot(missing);
    }
  }
  std::vector<ContactGap> result(closed_);
  for (Eigen::Index k = 0; k < count; ++k) {
    const SpringPlace& place = places_[std::size_t(k)];
    double& gap = place.axis == 1 ? result[place.patch].normal : result[place.patch].tangential;
    gap = gaps[k] / (1 + place.compliance * place.stiffness);
  }
  return result;
}

}  // namespace cdca
