// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/contact_spots.hpp"

#include <algorithm>

namespace cdca {

namespace {

/// Mean of a segment's slips over a stretch of it.
double slip_over(const std::vector<ContactSpots::Slip>& slips, double from, double to) {
  double sum = 0.0, length = 0.0;
  for (const ContactSpots::Slip& s : slips) {
    const double shared = std::min(to, s.to) - std::max(from, s.from);
    if (shared <= 0.0) continue;
    sum += shared * s.slip;
    length += shared;
  }
  return length > 0.0 ? sum / length : 0.0;
}

}  // namespace

ContactSpots::ContactSpots(const BasisContext& c, const std::vector<Crack>& cracks,
                           const ContactPatches& patches, const ElasticMatrix& elastic,
                           const Slips& slips) {
  for (const GlobalId id : c.cuts.touched_elements()) {
    const GridIndex e = c.mesh.grid().element_index(id);
    if (c.mesh.find_element(e) < 0) continue;
    for (const CrackFace& face : c.cuts.faces_of(e))
      add_face(c, cracks, patches, elastic, slips, face, c.mesh.evaluates(e));
  }
}

void ContactSpots::add_face(const BasisContext& c, const std::vector<Crack>& cracks,
                            const ContactPatches& patches, const ElasticMatrix& elastic,
                            const Slips& slips, const CrackFace& face, bool evaluated) {
  const auto shares = patches.shares(face);
  if (shares.empty()) return;
  const Crack& crack = cracks[std::size_t(face.crack)];
  const Vec2 &a = crack.points[std::size_t(face.segment)],
             &b = crack.points[std::size_t(face.segment) + 1];
  const FaceBasis basis(c, face, elastic);
  faces_.push_back({basis.geometry(), face.plus_element, face.minus_element, face.plus_part,
                    face.minus_part, Segment{double(face.crack), a.x(), a.y(), b.x(), b.y()},
                    evaluated});
  const auto known = slips.find(faces_.back().segment);
  const StructuredGrid& grid = c.mesh.grid();
  const auto along = [&](double s) {
    return patches.fraction(face.crack, face.segment,
                            grid.from_grid(face.from + s * (face.to - face.from)));
  };
  for (const ContactPatches::Share& share : shares) {
    const auto found = basis.spots(share.from, share.to);
    for (std::size_t k = 0; k < found.size(); ++k) {
      // spots at the ends of a stretch stand for its halves
      const auto cut = [&](std::size_t n) {
        return share.from + double(n) / double(found.size()) * (share.to - share.from);
      };
      const double from = along(cut(k)), to = along(cut(k + 1));
      Slip slip{faces_.back().segment, std::min(from, to), std::max(from, to), 0.0};
      if (known != slips.end()) slip.slip = slip_over(known->second, slip.from, slip.to);
      spots_.push_back({faces_.size() - 1, share.patch, slip, found[k]});
    }
  }
}

void ContactSpots::measure(std::span<const double> state, ContactPatches& patches,
                           Communicator& communicator) const {
  // per patch: length, and gap times length (tangential, normal)
  std::vector<double> sums(3 * patches.patches().size(), 0.0);
  for (const Spot& spot : spots_) {
    const Face& face = faces_[spot.face];
    if (!face.evaluated) continue;
    const ContactPatch& patch = patches.patches()[spot.patch];
    const ContactSpec& law = patches.law_of(patch);
    const auto field = spot.at.field(face.geometry, state);
    const auto gap = [&](double spring, double jump, double stress) {
      if (spring <= 0.0) return jump;
      const SpringTerms terms(face.geometry, spot.at.compliance, spring);
      return (terms.jump * jump + terms.mixed * stress) / spring;
    };
    // an open cohesive face is a spring of its own; others would close with these
    const bool pulls = patch.now.state != ContactState::open && patch.gap.normal > 0.0;
    const double normal = pulls ? patch.now.normal_spring : law.normal_stiffness;
    double* sum = &sums[3 * spot.patch];
    sum[0] += spot.at.weight;
    sum[1] +=
        spot.at.weight * gap(law.tangential_stiffness, stretched(spot, field), field.traction.x());
    sum[2] += spot.at.weight * gap(normal, field.jump.y(), field.traction.y());
  }
  communicator.sum(std::span<double>(sums));
  for (std::size_t p = 0; p < patches.patches().size(); ++p) {
    const double* sum = &sums[3 * p];
    if (sum[0] > 0.0) patches.patches()[p].gap = {sum[2] / sum[0], sum[1] / sum[0]};
  }
}

void ContactSpots::add_forces(const ContactPatches& patches, LocalId owned,
                              std::span<double> forces) const {
  for (const Spot& spot : spots_) {
    const Face& face = faces_[spot.face];
    const ContactAnswer& now = patches.patches()[spot.patch].now;
    // a given traction, or a spring whose zero has slipped away
    double on_jump = now.slides() ? now.tangential : 0.0;
    double on_stress = face.geometry.uses_stress ? spot.at.compliance * on_jump : 0.0;
    if (now.tangential_spring > 0.0) {
      const SpringTerms terms(face.geometry, spot.at.compliance, now.tangential_spring);
      on_jump = -spot.slip.slip * terms.jump;
      on_stress = -spot.slip.slip * terms.mixed;
    }
    if (on_jump == 0.0) continue;
    const Vec2& t = face.geometry.tangent;
    for (const FaceFunction& f : spot.at.functions) {
      if (f.unknown >= owned) continue;
      const Vec2 force =
          -spot.at.weight * (on_jump * f.jump * t + on_stress * f.traction.transpose() * t);
      forces[std::size_t(f.unknown)] += force.x();
      forces[std::size_t(f.unknown) + 1] += force.y();
    }
  }
}

double ContactSpots::energy_correction(const ContactPatches& patches, std::span<const double> state,
                                       Communicator& communicator) const {
  // u K u / 2 counts 1/2 (a g^2 + 2 b s g - c s^2) with the whole jump for g
  double sum = 0.0;
  for (const Spot& spot : spots_) {
    const Face& face = faces_[spot.face];
    if (!face.evaluated) continue;
    const ContactPatch& patch = patches.patches()[spot.patch];
    const double stiffness = patches.law_of(patch).tangential_stiffness, slip = spot.slip.slip;
    if (patch.now.slides() && stiffness > 0.0) {
      const double t = patch.now.tangential;
      sum += spot.at.weight * 0.5 * (1 / stiffness + spot.at.compliance) * t * t;
    } else if (patch.now.tangential_spring > 0.0 && slip != 0.0) {
      const SpringTerms terms(face.geometry, spot.at.compliance, patch.now.tangential_spring);
      const auto field = spot.at.field(face.geometry, state);
      sum += spot.at.weight * (terms.jump * (0.5 * slip * slip - slip * field.jump.x()) -
                               terms.mixed * slip * field.traction.x());
    }
  }
  return communicator.sum(sum);
}

double ContactSpots::accept(const ContactPatches& patches, std::span<const double> state,
                            Communicator& communicator) {
  double work = 0.0;
  for (Spot& spot : spots_) {
    const Face& face = faces_[spot.face];
    const ContactPatch& patch = patches.patches()[spot.patch];
    if (patch.now.tangential_spring > 0.0) continue;
    // the spring would stand here; open faces stick where they close again
    const auto field = spot.at.field(face.geometry, state);
    const double stiffness = patches.law_of(patch).tangential_stiffness, s = spot.at.compliance;
    double slip = field.jump.x();
    if (face.geometry.uses_stress) slip += s * field.traction.x();
    if (stiffness > 0.0) slip -= (1 / stiffness + s) * patch.now.tangential;
    if (face.evaluated)
      work += 0.5 * spot.at.weight * (patch.tangential + patch.now.tangential) *
              (slip - spot.slip.slip);
    spot.slip.slip = slip;
  }
  return communicator.sum(work);
}

ContactSpots::Slips ContactSpots::slips() const {
  Slips slips;
  for (const Spot& spot : spots_) slips[spot.slip.segment].push_back(spot.slip);
  return slips;
}

std::vector<ContactSpots::Slip> ContactSpots::all_slips(Communicator& communicator) const {
  std::vector<Slip> own;
  for (const Spot& spot : spots_) {
    if (faces_[spot.face].evaluated) own.push_back(spot.slip);
  }
  return communicator.agree(own, std::less<Slip>());
}

ContactSpots::Slips ContactSpots::by_segment(const std::vector<Slip>& slips) {
  Slips sorted;
  for (const Slip& slip : slips) sorted[slip.segment].push_back(slip);
  return sorted;
}

void ContactSpots::find_bodies(const BodyOf& body_of, ContactPatches& patches,
                               Communicator& communicator) const {
  std::vector<double> bodies(2 * patches.patches().size(), -1.0);
  for (const Spot& spot : spots_) {
    const Face& face = faces_[spot.face];
    if (!face.evaluated) continue;
    bodies[2 * spot.patch] = body_of(face.plus, face.plus_part);
    bodies[2 * spot.patch + 1] = body_of(face.minus, face.minus_part);
  }
  communicator.max(std::span<double>(bodies));
  for (std::size_t p = 0; p < patches.patches().size(); ++p)
    patches.patches()[p].bodies = {int(bodies[2 * p]), int(bodies[2 * p + 1])};
}

}  // namespace cdca
