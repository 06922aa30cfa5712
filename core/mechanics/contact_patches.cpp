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

}  // namespace

ContactPatches::ContactPatches(const StructuredGrid& grid, const std::vector<ContactSpec>& laws,
                               const std::vector<Crack>& cracks, const ContactPatches* previous)
    : grid_(grid), laws_(laws) {
  std::map<Key, const Run*> known;
  if (previous) {
    for (const auto& [place, run] : previous->runs_)
      known[key_of(place.first, run.a, run.b)] = &run;
  }
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    if (laws[c].law == ContactLaw::none) continue;
    for (std::size_t k = 0; k < cracks[c].segments(); ++k) {
      const Vec2 &a = cracks[c].points[k], &b = cracks[c].points[k + 1];
      const double length = (b - a).norm();
      const auto count =
          std::size_t(std::max(1.0, std::round(0.5 * length / grid.smallest_side())));
      runs_[{int(c), int(k)}] = {patches_.size(), count, a, b};
      const auto old = known.find(key_of(int(c), a, b));
      for (std::size_t p = 0; p < count; ++p) {
        ContactPatch patch;
        if (old != known.end()) {
          patch = previous->patches_[old->second->first + p];
        } else if (!previous) {
          patch.now = touching(laws[c]);
        }
        patch.crack = int(c);
        patch.segment = int(k);
        patch.from = double(p) / double(count);
        patch.to = double(p + 1) / double(count);
        patch.length = length / double(count);
        patches_.push_back(patch);
      }
    }
  }
}

double ContactPatches::fraction(int crack, int segment, const Vec2& x) const {
  return run_of(crack, segment)->fraction(x);
}

void ContactPatches::put_back(const std::vector<ContactPatch>& patches) {
  const auto same = [](const ContactPatch& a, const ContactPatch& b) {
    return a.crack == b.crack && a.segment == b.segment && a.from == b.from;
  };
  if (!std::equal(patches.begin(), patches.end(), patches_.begin(), patches_.end(), same))
    throw IoError("The checkpoint does not fit the case: other faces touch.");
  patches_ = patches;
}

const ContactPatches::Run* ContactPatches::run_of(int crack, int segment) const {
  const auto it = runs_.find({crack, segment});
  return it == runs_.end() ? nullptr : &it->second;
}

std::vector<ContactPatches::Share> ContactPatches::shares(const CrackFace& face) const {
  const Run* run = run_of(face.crack, face.segment);
  if (!run) return {};
  const double f0 = run->fraction(grid_.from_grid(face.from));
  const double f1 = run->fraction(grid_.from_grid(face.to));
  if (std::abs(f1 - f0) < 1e-14) return {};
  const double low = std::min(f0, f1), high = std::max(f0, f1), count = double(run->count);
  const auto clamped = [&](double f) {
    return std::size_t(std::clamp(std::floor(f * count), 0.0, count - 1));
  };
  std::vector<Share> found;
  const std::size_t first = clamped(low + 1e-9), last = clamped(high - 1e-9);
  for (std::size_t p = first; p <= last; ++p) {
    const double a = p == first ? low : double(p) / count;
    const double b = p == last ? high : double(p + 1) / count;
    const double from = (a - f0) / (f1 - f0), to = (b - f0) / (f1 - f0);
    found.push_back({run->first + p, std::min(from, to), std::max(from, to)});
  }
  return found;
}

std::vector<FaceStretch> ContactPatches::on(const CrackFace& face) const {
  std::vector<FaceStretch> stretches;
  for (const Share& s : shares(face)) {
    const ContactAnswer& now = patches_[s.patch].now;
    stretches.push_back({s.from, s.to, now.normal_spring, now.tangential_spring});
  }
  return stretches;
}

ContactPatches::Change ContactPatches::respond() {
  Change change;
  for (ContactPatch& p : patches_) {
    const ContactAnswer next = contact_answer(law_of(p), p.largest, p.now, p.gap);
    const double scale = std::max(next.normal_spring, p.now.normal_spring);
    change.springs = change.springs || next.tangential_spring != p.now.tangential_spring ||
                     std::abs(next.normal_spring - p.now.normal_spring) > 1e-9 * scale;
    if (next.slides() || p.now.slides())
      change.traction = std::max(change.traction, std::abs(next.tangential - p.now.tangential));
    change.largest = std::max({change.largest, std::abs(next.normal), std::abs(next.tangential)});
    p.now = next;
  }
  return change;
}

void ContactPatches::accept() {
  for (ContactPatch& p : patches_) {
    p.largest = p.now.largest;
    p.tangential = p.now.tangential;
  }
}

const ContactPatch* ContactPatches::find(int crack, int segment, const Vec2& x) const {
  const Run* run = run_of(crack, segment);
  if (!run) return nullptr;
  const double place = std::floor(run->fraction(x) * double(run->count));
  return &patches_[run->first + std::size_t(std::clamp(place, 0.0, double(run->count - 1)))];
}

Vec2 ContactPatches::on_plus(int crack, int segment, const Vec2& x) const {
  const ContactPatch* patch = find(crack, segment, x);
  if (!patch || patch->now.state == ContactState::open) return {0, 0};
  const Run& run = *run_of(crack, segment);
  const Vec2 t = (run.b - run.a).normalized();
  return -patch->now.normal * turned_left(t) - patch->now.tangential * t;
}

}  // namespace cdca
