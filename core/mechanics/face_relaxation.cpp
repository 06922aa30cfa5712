// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/face_relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cdca {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr std::size_t depth = 20;  ///< of mixing: about as many blocks may move as a whole
constexpr double worse = 2.0;      ///< off by so many times more, a mixed step is taken back

}  // namespace

FaceRelaxation::FaceRelaxation(const ContactPatches& patches, std::vector<double> compliances,
                               const std::vector<ContactGap>& gaps, double stiffness)
    : mixing_(depth), before_(no_limit) {
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

void FaceRelaxation::answer_to(const std::vector<double>& values) {
  auto value = values.begin();
  const auto set = [&](Side& side, double spring, double least, double most) {
    side.traction = std::clamp(*value * spring / (1 + spring * side.compliance), least, most);
    side.gap = *value++ - side.traction / spring;
  };
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    Face& face = faces_[k];
    if (!face.relaxed) continue;
    set(face.normal, face.spring, -no_limit, 0.0);
    if (face.tangential.compliance == 0.0) continue;
    const double pressed = face.normal.traction / laws_[k].normal_stiffness;
    face.limit = face.normal.traction == 0.0 ? 0.0 : limit_at(laws_[k], pressed);
    set(face.tangential, face.spring, -face.limit, face.limit);
  }
}

double FaceRelaxation::take(const std::vector<ContactGap>& gaps) {
  constexpr double beyond = 1.6;  // over-relaxation
  std::vector<double> tried, found;
  double off = 0.0, largest = 0.0, widest = 0.0, squares = 0.0;
  const auto add = [&](const Side& side, double spring, double gap) {
    tried.push_back(side.gap + side.traction / spring);
    found.push_back(tried.back() + beyond * (gap - side.gap));
    const double apart = spring * (gap - side.gap);
    off = std::max(off, std::abs(apart));
    squares += apart * apart;
    widest = std::max(widest, std::abs(spring * gap));
  };
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    Face& face = faces_[k];
    face.found = gaps[k];
    if (!face.relaxed) continue;
    largest = std::max(largest, -face.normal.traction);
    add(face.normal, face.spring, gaps[k].normal * face.normal.scale);
    if (face.tangential.compliance > 0.0)
      add(face.tangential, face.spring, gaps[k].tangential * face.tangential.scale);
  }
  const double now = std::sqrt(squares);
  if (now > worse * before_) {
    mixing_.forget();
    before_ = no_limit;
    answer_to(plain_);
  } else {
    before_ = now;
    plain_ = found;
    answer_to(mixing_.next(tried, found));
  }
  const double scale = largest > 0.0 ? largest : widest;
  return scale > 0.0 ? off / scale : 0.0;
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
