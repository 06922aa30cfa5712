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

ContactPatches::ContactPatches(const StructuredGrid& grid, const ElasticMatrix& elastic,
                               const std::vector<ContactSpec>& laws,
                               const std::vector<Crack>& cracks, const ContactPatches* previous)
    : grid_(grid), elastic_(elastic), laws_(laws) {
  std::map<Key, const Run*> known;
  if (previous) {
    for (const auto& [place, run] : previous->runs_)
      known[key_of(place.first, run.a, run.b)] = &run;
  }
  const double h = grid.smallest_side();
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    if (laws[c].law == ContactLaw::none) continue;
    for (std::size_t k = 0; k < cracks[c].segments(); ++k) {
      const Vec2 &a = cracks[c].points[k], &b = cracks[c].points[k + 1];
      const double length = (b - a).norm();
      const auto count = std::size_t(std::max(1.0, std::round(length / h)));
      runs_[{int(c), int(k)}] = {patches_.size(), count, a, b};
      const auto old = known.find(key_of(int(c), a, b));
      for (std::size_t p = 0; p < count; ++p) {
        ContactPatch patch;
        if (old != known.end()) {
          patch = previous->patches_[old->second->first + p];
        } else {
          if (!previous) patch.now = touching(laws[c], {});
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
    if (now.normal_spring == 0.0 && now.tangential_spring == 0.0) continue;
    stretches.push_back({s.from, s.to, now.normal_spring, now.tangential_spring});
  }
  return stretches;
}

template <class Pass, class Visit>
void ContactPatches::for_faces(const BasisContext& c, Pass pass, Visit visit) const {
  for (const GlobalId id : c.cuts.touched_elements()) {
    const GridIndex e = c.mesh.grid().element_index(id);
    if (c.mesh.find_element(e) < 0 || !pass(e)) continue;
    for (const CrackFace& face : c.cuts.faces_of(e)) {
      const auto parts = shares(face);
      if (parts.empty()) continue;
      const FaceBasis basis(c, face, elastic_);
      for (const Share& s : parts) visit(basis, s);
    }
  }
}

void ContactPatches::measure(const BasisContext& c, std::span<const double> state,
                             Communicator& communicator) {
  std::vector<double> sums(2 * patches_.size(), 0.0);
  std::vector<FaceFunction> functions;
  for_faces(
      c, [&](GridIndex e) { return c.mesh.evaluates(e); },
      [&](const FaceBasis& basis, const Share& s) {
        const ContactPatch& patch = patches_[s.patch];
        const ContactSpec& law = laws_[std::size_t(patch.crack)];
        // an open cohesive face is a spring of its own; others would close with these
        const bool pulls = patch.now.state != ContactState::open && patch.gap.y() > 0.0;
        const double k_n = pulls ? patch.now.normal_spring : law.normal_stiffness;
        const double k_t = law.tangential_stiffness;
        for (const FacePoint& p : basis.points(s.from, s.to)) {
          basis.evaluate(p.at, functions);
          const auto field = basis.field(functions, state);
          const auto gap = [&](double k, double jump, double stress) {
            if (k <= 0.0) return jump;
            const SpringTerms terms(basis.geometry(), k);
            return (terms.jump * jump + terms.mixed * stress) / k;
          };
          const double slip = k_t > 0.0 ? patch.history.slip : 0.0;
          sums[2 * s.patch] +=
              p.weight * (slip + gap(k_t, field.jump.x() - slip, field.traction.x()));
          sums[2 * s.patch + 1] += p.weight * gap(k_n, field.jump.y(), field.traction.y());
        }
      });
  communicator.sum(std::span<double>(sums));
  for (std::size_t p = 0; p < patches_.size(); ++p)
    patches_[p].gap = Vec2(sums[2 * p], sums[2 * p + 1]) / patches_[p].length;
}

ContactPatches::Change ContactPatches::respond() {
  Change change;
  for (ContactPatch& p : patches_) {
    const ContactAnswer next =
        contact_answer(laws_[std::size_t(p.crack)], p.history, p.gap.y(), p.gap.x());
    const double scale = std::max(next.normal_spring, p.now.normal_spring);
    change.springs = change.springs || next.tangential_spring != p.now.tangential_spring ||
                     std::abs(next.normal_spring - p.now.normal_spring) > 1e-9 * scale;
    change.traction = std::max(change.traction, std::abs(next.offset - p.now.offset));
    change.largest = std::max({change.largest, std::abs(next.normal), std::abs(next.tangential)});
    p.now = next;
  }
  return change;
}

void ContactPatches::accept() {
  for (ContactPatch& p : patches_) p.history = p.now.history;
}

void ContactPatches::add_forces(const BasisContext& c, std::span<double> forces) const {
  std::vector<FaceFunction> functions;
  for_faces(
      c, [](GridIndex) { return true; },
      [&](const FaceBasis& basis, const Share& s) {
        const ContactAnswer& now = patches_[s.patch].now;
        if (now.offset == 0.0) return;
        // a given traction, or a spring whose zero has slipped away
        double on_jump = now.offset, on_stress = 0.0;
        if (now.tangential_spring > 0.0) {
          const SpringTerms terms(basis.geometry(), now.tangential_spring);
          on_jump = now.offset / now.tangential_spring * terms.jump;
          on_stress = now.offset / now.tangential_spring * terms.mixed;
        }
        const Vec2& t = basis.geometry().tangent;
        for (const FacePoint& p : basis.points(s.from, s.to)) {
          basis.evaluate(p.at, functions);
          for (const FaceFunction& f : functions) {
            if (f.unknown >= c.unknowns.owned()) continue;
            const Vec2 force =
                -p.weight * (on_jump * f.jump * t + on_stress * f.traction.transpose() * t);
            forces[std::size_t(f.unknown)] += force.x();
            forces[std::size_t(f.unknown) + 1] += force.y();
          }
        }
      });
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

double ContactPatches::energy_correction(const BasisContext& c, std::span<const double> state,
                                         Communicator& communicator) const {
  if (patches_.empty()) return 0.0;
  // u K u / 2 counts 1/2 (a g^2 + 2 b s g - c s^2) with the whole tangential gap g
  double sum = 0.0;
  std::vector<FaceFunction> functions;
  for_faces(
      c, [&](GridIndex e) { return c.mesh.evaluates(e); },
      [&](const FaceBasis& basis, const Share& s) {
        const ContactAnswer& now = patches_[s.patch].now;
        if (now.tangential_spring <= 0.0 || now.offset == 0.0) return;
        const SpringTerms terms(basis.geometry(), now.tangential_spring);
        const double slip = -now.offset / now.tangential_spring;
        for (const FacePoint& p : basis.points(s.from, s.to)) {
          basis.evaluate(p.at, functions);
          const auto field = basis.field(functions, state);
          sum += p.weight * (terms.jump * (0.5 * slip * slip - slip * field.jump.x()) -
                             terms.mixed * slip * field.traction.x());
        }
      });
  sum = communicator.sum(sum);
  for (const ContactPatch& p : patches_) {
    const double stiffness = laws_[std::size_t(p.crack)].tangential_stiffness;
    if (p.now.tangential_spring == 0.0 && p.now.tangential != 0.0)
      sum += 0.5 * p.length * p.now.tangential * p.now.tangential / stiffness;
  }
  return sum;
}

double ContactPatches::friction_work() const {
  double sum = 0.0;
  for (const ContactPatch& p : patches_)
    sum += p.length * p.now.tangential * (p.now.history.slip - p.history.slip);
  return sum;
}

void ContactPatches::find_bodies(const BasisContext& c, const BodyOf& body_of,
                                 Communicator& communicator) {
  std::vector<double> bodies(2 * patches_.size(), -1.0);
  for (const GlobalId id : c.cuts.touched_elements()) {
    const GridIndex e = c.mesh.grid().element_index(id);
    if (!c.mesh.evaluates(e) || c.mesh.find_element(e) < 0) continue;
    for (const CrackFace& face : c.cuts.faces_of(e)) {
      for (const Share& s : shares(face)) {
        bodies[2 * s.patch] = body_of(face.plus_element, face.plus_part);
        bodies[2 * s.patch + 1] = body_of(face.minus_element, face.minus_part);
      }
    }
  }
  communicator.max(std::span<double>(bodies));
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    patches_[p].bodies = {int(bodies[2 * p]), int(bodies[2 * p + 1])};
  }
}

}  // namespace cdca
