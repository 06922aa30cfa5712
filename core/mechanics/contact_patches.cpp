// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/contact_patches.hpp"

#include "core/base/errors.hpp"

#include <algorithm>
#include <cmath>

namespace cdca {

namespace {

/// A segment is known again by its ends: growth adds segments, it does not change them.
using Key = std::array<double, 5>;
Key key_of(int crack, const Vec2& a, const Vec2& b) {
  return {double(crack), a.x(), a.y(), b.x(), b.y()};
}

/// Of springs, Pa/m.
bool differ(double a, double b) { return std::abs(a - b) > 1e-9 * std::max(a, b); }

bool slides(const ContactPatch& p) {
  return p.now.state == ContactState::slip && p.now.tangential_spring == 0.0;
}

}  // namespace

std::vector<GlobalId> elements_with_other_springs(const SpringsOfElements& before,
                                                  const SpringsOfElements& now) {
  std::vector<GlobalId> found;
  for (const auto& [id, springs] : now) {
    const auto was = before.find(id);
    if (was == before.end() || was->second != springs) found.push_back(id);
  }
  return found;
}

ContactPatches::ContactPatches(const ElementCuts& cuts, const std::vector<ContactSpec>& laws,
                               const std::vector<Crack>& cracks, const ContactPatches* previous)
    : laws_(laws), grid_(cuts.grid()) {
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    if (!may_touch(int(c))) continue;
    for (std::size_t k = 0; k < cracks[c].segments(); ++k)
      segments_[{int(c), int(k)}] = {cracks[c].points[k], cracks[c].points[k + 1], {}};
  }
  if (segments_.empty()) return;
  for (const GlobalId id : cuts.touched_elements()) {
    std::vector<std::vector<std::size_t>> of_faces;
    for (const CrackFace& face : cuts.faces_of(grid_.element_index(id))) {
      of_faces.emplace_back();
      if (may_touch(face.crack)) add_face(grid_, face, of_faces.back());
    }
    if (!of_faces.empty()) at_.emplace(id, std::move(of_faces));
  }
  group_patches(2 * grid_.smallest_side());
  for (ContactPatch& p : patches_) {
    if (!previous) p.now = touching(law_of(p));
  }
  if (previous) take_over(*previous);
  find_means();
}

void ContactPatches::add_face(const StructuredGrid& grid, const CrackFace& face,
                              std::vector<std::size_t>& own) {
  Segment& segment = segments_.at({face.crack, face.segment});
  const bool inside = face.plus_element == face.minus_element;
  const Vec2 along = (segment.b - segment.a).normalized();
  const double length =
      std::abs((face.to - face.from).cwiseProduct(grid.element_size()).dot(along));
  const auto cut = [&](double s) {
    return segment.fraction(grid.from_grid(face.from + s * (face.to - face.from)));
  };
  for (int half = 0; half < (inside ? 1 : 2); ++half) {
    const double a = cut(inside ? 0.0 : 0.5 * half), b = cut(inside ? 1.0 : 0.5 * (half + 1));
    ContactPatch patch;
    patch.crack = face.crack;
    patch.segment = face.segment;
    patch.from = std::min(a, b);
    patch.to = std::max(a, b);
    patch.length = inside ? length : 0.5 * length;
    own.push_back(patches_.size());
    segment.patches.push_back(patches_.size());
    patches_.push_back(patch);
  }
}

void ContactPatches::group_patches(double size) {
  constexpr double rounding = 1e-9;
  for (auto& [place, segment] : segments_) {
    // odd, and patches between two groups go to the one nearer the middle: so that both halves of
    // a segment are divided alike
    const double pairs = std::round(0.5 * ((segment.b - segment.a).norm() / size - 1));
    const double count = 2 * std::max(0.0, pairs) + 1;
    const std::size_t first = groups_.size();
    groups_.resize(first + std::size_t(count));
    for (const std::size_t k : segment.patches) {
      const double middle = 0.5 * (patches_[k].from + patches_[k].to) * count;
      const double inwards = middle < 0.5 * count ? rounding : -rounding;
      patches_[k].group =
          first + std::size_t(std::clamp(std::floor(middle + inwards), 0.0, count - 1));
    }
  }
}

void ContactPatches::take_over(const ContactPatches& previous) {
  std::map<Key, const Segment*> known;
  for (const auto& [place, segment] : previous.segments_)
    known[key_of(place.first, segment.a, segment.b)] = &segment;
  for (auto& [place, segment] : segments_) {
    const auto old = known.find(key_of(place.first, segment.a, segment.b));
    if (old == known.end()) continue;
    for (const std::size_t k : segment.patches) {
      ContactPatch& p = patches_[k];
      double sum = 0.0, most = 0.0;
      for (const std::size_t o : old->second->patches) {
        const ContactPatch& q = previous.patches_[o];
        const double shared = std::min(p.to, q.to) - std::max(p.from, q.from);
        if (shared <= 0.0) continue;
        sum += shared;
        p.slip += shared * q.slip;
        p.largest += shared * q.largest;
        p.tangential += shared * q.tangential;
        if (shared > most) most = shared, p.now = q.now, p.gap = q.gap, p.limit = q.limit;
      }
      if (sum > 0.0) p.slip /= sum, p.largest /= sum, p.tangential /= sum;
    }
  }
}

void ContactPatches::put_back(const std::vector<ContactPatch>& patches) {
  const auto same = [](const ContactPatch& a, const ContactPatch& b) {
    return a.crack == b.crack && a.segment == b.segment && a.from == b.from;
  };
  if (!std::equal(patches.begin(), patches.end(), patches_.begin(), patches_.end(), same))
    throw IoError("The checkpoint does not fit the case: other faces touch.");
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const std::size_t group = patches_[p].group;
    patches_[p] = patches[p];
    patches_[p].group = group;  // follows from the cracks, and is not written down
  }
  find_means();
}

std::vector<std::size_t> ContactPatches::of_face(GridIndex element, std::size_t face) const {
  const auto it = at_.find(grid_.element(element));
  return it == at_.end() ? std::vector<std::size_t>() : it->second.at(face);
}

std::vector<FaceStretch> ContactPatches::on(GridIndex element, std::size_t face) const {
  std::vector<FaceStretch> stretches;
  const auto own = of_face(element, face);
  for (std::size_t k = 0; k < own.size(); ++k) {
    const ContactPatch& p = patches_[own[k]];
    const double share = 1.0 / double(own.size());
    stretches.push_back(
        {double(k) * share, double(k + 1) * share, p.now.normal_spring, p.now.tangential_spring});
  }
  return stretches;
}

SpringsOfElements ContactPatches::springs() const {
  SpringsOfElements all;
  for (const auto& [id, faces] : at_) {
    auto& own = all[id];
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const auto stretches = on(grid_.element_index(id), k);
      own.insert(own.end(), stretches.begin(), stretches.end());
    }
  }
  return all;
}

std::vector<ContactAnswer> ContactPatches::answers_to(const std::vector<ContactGap>& gaps) const {
  std::vector<ContactAnswer> answers;
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    const ContactPatch& p = patches_[k];
    answers.push_back(contact_answer(law_of(p), p.largest, gaps[k], p.limit));
  }
  return answers;
}

bool ContactPatches::settled(const std::vector<ContactGap>& gaps) const {
  const auto answers = answers_to(gaps);
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    const ContactAnswer &now = patches_[k].now, &next = answers[k];
    if (differ(next.normal_spring, now.normal_spring) ||
        differ(next.tangential_spring, now.tangential_spring))
      return false;
    const bool turned = next.tangential_spring == 0.0 && next.tangential * now.tangential < 0.0;
    if (turned) return false;
  }
  return true;
}

std::vector<double> ContactPatches::limits() const {
  std::vector<double> limits;
  for (const ContactPatch& p : patches_) limits.push_back(p.limit);
  return limits;
}

std::vector<double> ContactPatches::limits_at(const std::vector<ContactGap>& gaps) const {
  std::vector<double> limits;
  for (std::size_t k = 0; k < patches_.size(); ++k)
    limits.push_back(limit_at(law_of(patches_[k]), gaps[k].normal));
  return limits;
}

ContactPatches::SlidingLimits ContactPatches::limits_of_sliding(
    const std::vector<ContactGap>& gaps) const {
  SlidingLimits found{limits(), 0.0};
  double change = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    const ContactPatch& p = patches_[k];
    largest = std::max({largest, std::abs(p.now.normal_spring * gaps[k].normal), p.limit});
    if (!slides(p)) continue;
    found.limits[k] = limit_at(law_of(p), gaps[k].normal);
    change = std::max(change, std::abs(found.limits[k] - p.limit));
  }
  if (largest > 0.0) found.off = change / largest;
  return found;
}

void ContactPatches::slide_at(const std::vector<double>& limits) {
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    ContactPatch& p = patches_[k];
    if (!slides(p)) continue;
    p.limit = limits[k];
    p.now.tangential = std::copysign(limits[k], p.now.tangential);
  }
}

double ContactPatches::unbalanced(const ContactPatch& p, const ContactGap& gap,
                                  const ContactAnswer& next) const {
  // what the last solve counted with: springs, or given tractions
  const double normal = p.now.normal_spring * gap.normal;
  const double tangential =
      p.now.tangential_spring > 0.0 ? p.now.tangential_spring * gap.tangential : p.now.tangential;
  return std::max(std::abs(next.normal - normal), std::abs(next.tangential - tangential));
}

ContactPatches::Change ContactPatches::respond(const std::vector<ContactGap>& gaps,
                                               const std::vector<double>& limits) {
  Change change;
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    ContactPatch& p = patches_[k];
    const ContactSpec& law = law_of(p);
    const double found = limit_at(law, gaps[k].normal);
    change.unbalanced = std::max(
        change.unbalanced, unbalanced(p, gaps[k], contact_answer(law, p.largest, gaps[k], found)));
    const ContactAnswer next = contact_answer(law, p.largest, gaps[k], limits[k]);
    change.at_limits = std::max(change.at_limits, unbalanced(p, gaps[k], next));
    change.largest = std::max({change.largest, std::abs(next.normal), std::abs(next.tangential)});
    change.springs = change.springs || differ(p.now.normal_spring, next.normal_spring) ||
                     differ(p.now.tangential_spring, next.tangential_spring);
    p.now = next;
    p.gap = gaps[k];
    p.limit = limits[k];
  }
  find_means();
  return change;
}

double ContactPatches::least_holding(double tolerance) const {
  // tractions are balanced to ten times the tolerance; what is near to that may be there or not
  constexpr double above_rounding = 100;
  double largest = 0.0;
  for (const ContactPatch& p : patches_) largest = std::max(largest, std::abs(p.now.normal));
  return above_rounding * tolerance * largest;
}

bool ContactPatches::holds(const ContactPatch& patch, double least) {
  // new faces touch without a traction until an equilibrium shows what they do
  const double traction = std::abs(patch.now.normal);
  return patch.now.state != ContactState::open && (traction == 0.0 || traction > least);
}

void ContactPatches::find_means() {
  for (ContactGroup& g : groups_) g = {};
  for (const ContactPatch& p : patches_) {
    ContactGroup& g = groups_[p.group];
    g.length += p.length;
    g.gap += p.length * p.gap.normal;
    if (p.now.state == ContactState::open) continue;
    g.closed += p.length;
    g.normal += p.length * p.now.normal;
    g.tangential += p.length * p.now.tangential;
  }
  for (ContactGroup& g : groups_) {
    if (g.length > 0.0) g.gap /= g.length;
    if (g.closed > 0.0) g.normal /= g.closed, g.tangential /= g.closed;
  }
}

void ContactPatches::accept() {
  for (ContactPatch& p : patches_) {
    p.largest = p.now.largest;
    p.tangential = p.now.tangential;
  }
}

const ContactPatch* ContactPatches::find(int crack, int segment, const Vec2& x) const {
  const auto it = segments_.find({crack, segment});
  if (it == segments_.end()) return nullptr;
  const double s = it->second.fraction(x);
  const ContactPatch* nearest = nullptr;
  double least = 0.0;
  for (const std::size_t k : it->second.patches) {
    const ContactPatch& p = patches_[k];
    const double off = std::max({p.from - s, s - p.to, 0.0});
    if (!nearest || off < least) nearest = &p, least = off;
  }
  return nearest;
}

Vec2 ContactPatches::on_plus(const ContactPatch& patch) const {
  const ContactGroup& group = group_of(patch);
  const Segment& s = segments_.at({patch.crack, patch.segment});
  const Vec2 t = (s.b - s.a).normalized();
  const Vec2 mean = -group.normal * turned_left(t) - group.tangential * t;
  // a short face that opens among closed ones tells how it lies in its element: its neighbours'
  // force is spread over it
  if (group.closed > 0.5 * group.length) return group.closed / group.length * mean;
  return patch.now.state == ContactState::open ? Vec2(0, 0) : mean;
}

}  // namespace cdca
