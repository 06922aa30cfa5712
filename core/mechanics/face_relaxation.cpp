// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/face_relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cdca {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

}  // namespace

FaceRelaxation::FaceRelaxation(const ContactPatches& patches, std::vector<double> compliances,
                               const std::vector<ContactGap>& gaps, double stiffness) {
  for (std::size_t k = 0; k < patches.patches().size(); ++k) {
    const ContactPatch& patch = patches.patches()[k];
    const ContactSpec& law = patches.law_of(patch);
    laws_.push_back(law);
    Face face;
    face.kept = patch.now;
    face.found = gaps[k];
    face.limit = patch.limit;
    face.relaxed = law.law != ContactLaw::cohesive;
    face.body = compliances[k];
    // the face's own share of the spring must stay positive
    face.spring = face.body > 0.0 ? std::min(stiffness, 0.5 / face.body) : stiffness;
    const auto start = [&](Side& side, double spring, double gap, double least, double most) {
      if (spring <= 0.0) return;
      side.scale = 1 + face.body * spring;
      side.compliance = 1 / spring + face.body;
      side.gap = gap * side.scale;
      side.traction = std::clamp(side.gap / side.compliance, least, most);
    };
    start(face.normal, law.normal_stiffness, gaps[k].normal, -no_limit, 0.0);
    const bool rubs = law.law == ContactLaw::coulomb;
    start(face.tangential, rubs ? law.tangential_stiffness : 0.0, gaps[k].tangential, -face.limit,
          face.limit);
    faces_.push_back(face);
  }
}

std::vector<ContactAnswer> FaceRelaxation::answers() const {
  std::vector<ContactAnswer> answers;
  for (const Face& face : faces_) {
    ContactAnswer a = face.kept;
    if (face.relaxed) {
      const double spring = 1 / (1 / face.spring - face.body);
      a = {};
      a.state = ContactState::stick;
      a.normal_spring = spring;
      a.normal_zero = face.normal.zero(face.spring);
      if (face.tangential.compliance > 0.0) {
        a.tangential_spring = spring;
        a.tangential_zero = face.tangential.zero(face.spring);
      }
    }
    answers.push_back(a);
  }
  return answers;
}

double FaceRelaxation::answer(Side& side, double spring, double gap, double least, double most) {
  constexpr double beyond = 1.6;  // over-relaxation
  const double before = side.traction;
  const double wanted = beyond * gap + (1 - beyond) * side.gap + side.traction / spring;
  side.traction = std::clamp(wanted * spring / (1 + spring * side.compliance), least, most);
  side.gap = wanted - side.traction / spring;
  return std::max(std::abs(side.traction - before), spring * std::abs(gap - side.gap));
}

double FaceRelaxation::take(const std::vector<ContactGap>& gaps) {
  double off = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    Face& face = faces_[k];
    face.found = gaps[k];
    if (!face.relaxed) continue;
    Side &n = face.normal, &t = face.tangential;
    off = std::max(off, answer(n, face.spring, gaps[k].normal * n.scale, -no_limit, 0.0));
    largest = std::max(largest, -n.traction);
    if (t.compliance == 0.0) continue;
    face.limit = limit_at(laws_[k], n.traction / laws_[k].normal_stiffness);
    if (n.traction == 0.0) face.limit = 0.0;
    off = std::max(off,
                   answer(t, face.spring, gaps[k].tangential * t.scale, -face.limit, face.limit));
  }
  return largest > 0.0 ? off / largest : 0.0;
}

std::vector<ContactGap> FaceRelaxation::gaps() const {
  std::vector<ContactGap> gaps;
  for (const Face& face : faces_) {
    ContactGap gap = face.found;
    if (face.relaxed) {
      gap.normal = face.normal.gap / face.normal.scale;
      if (face.tangential.compliance > 0.0)
        gap.tangential = face.tangential.gap / face.tangential.scale;
    }
    gaps.push_back(gap);
  }
  return gaps;
}

std::vector<double> FaceRelaxation::limits() const {
  std::vector<double> limits;
  for (const Face& face : faces_) limits.push_back(face.limit);
  return limits;
}

}  // namespace cdca
