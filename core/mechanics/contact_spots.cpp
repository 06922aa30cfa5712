// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/contact_spots.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace cdca {

ContactSpots::ContactSpots(const BasisContext& c, const ContactPatches& patches,
                           const ElasticMatrix& elastic) {
  if (patches.empty()) return;
  for (const GlobalId id : c.cuts.touched_elements()) {
    const GridIndex e = c.mesh.grid().element_index(id);
    if (c.mesh.find_element(e) < 0) continue;
    const auto faces = c.cuts.faces_of(e);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const auto own = patches.of_face(e, k);
      if (own.empty()) continue;
      const CrackFace& face = faces[k];
      const FaceBasis basis(c, face, elastic);
      for (std::size_t n = 0; n < own.size(); ++n) {
        const double share = 1.0 / double(own.size());
        spots_.push_back({own[n], basis.geometry(),
                          basis.spot(double(n) * share, double(n + 1) * share), face.plus_element,
                          face.minus_element, face.plus_part, face.minus_part,
                          c.mesh.evaluates(e)});
      }
    }
  }
}

std::vector<ContactGap> ContactSpots::gaps(std::span<const double> state,
                                           const ContactPatches& patches,
                                           Communicator& communicator) const {
  std::vector<double> sums(2 * patches.patches().size(), 0.0);
  for (const Spot& spot : spots_) {
    if (!spot.evaluated) continue;
    const ContactPatch& patch = patches.patches()[spot.patch];
    const ContactSpec& law = patches.law_of(patch);
    const auto field = spot.at.field(spot.geometry, state);
    const auto gap = [&](double spring, double jump, double stress) {
      if (spring <= 0.0)
        return jump + (spot.geometry.uses_stress ? spot.at.compliance * stress : 0);
      const SpringTerms terms(spot.geometry, spot.at.compliance, spring);
      return (terms.jump * jump + terms.mixed * stress) / spring;
    };
    // an open cohesive face is a spring of its own; others would close with these
    const bool pulls = law.law == ContactLaw::cohesive && patch.gap.normal > 0.0;
    const double normal = pulls ? patch.now.normal_spring : law.normal_stiffness;
    sums[2 * spot.patch] = gap(normal, field.jump.y(), field.traction.y());
    sums[2 * spot.patch + 1] =
        gap(law.tangential_stiffness, field.jump.x() - patch.slip, field.traction.x());
  }
  communicator.sum(std::span<double>(sums));
  std::vector<ContactGap> found;
  for (std::size_t p = 0; p < patches.patches().size(); ++p)
    found.push_back({sums[2 * p], sums[2 * p + 1]});
  return found;
}

std::vector<double> ContactSpots::compliances(const ContactPatches& patches,
                                              Communicator& communicator) const {
  std::vector<double> sums(patches.patches().size(), 0.0);
  for (const Spot& spot : spots_) {
    if (spot.evaluated && spot.geometry.uses_stress) sums[spot.patch] = spot.at.compliance;
  }
  communicator.sum(std::span<double>(sums));
  return sums;
}

std::vector<SpringPlace> ContactSpots::spring_places(const std::vector<ContactAnswer>& answers,
                                                     const ContactPatches& patches,
                                                     Communicator& communicator) const {
  std::vector<double> lengths(answers.size(), 0.0);
  for (const Spot& spot : spots_) {
    if (spot.evaluated) lengths[spot.patch] += spot.at.weight;
  }
  communicator.sum(std::span<double>(lengths));
  const auto shares = compliances(patches, communicator);
  std::vector<SpringPlace> places;
  for (std::size_t p = 0; p < answers.size(); ++p) {
    const double springs[] = {answers[p].tangential_spring, answers[p].normal_spring};
    for (int axis = 0; axis < 2; ++axis) {
      if (springs[axis] > 0.0) places.push_back({p, axis, lengths[p], shares[p], springs[axis]});
    }
  }
  return places;
}

std::vector<Effect> ContactSpots::effects_on(const std::vector<SpringPlace>& places) const {
  std::map<std::pair<std::size_t, int>, std::size_t> numbers;
  for (std::size_t k = 0; k < places.size(); ++k) numbers[{places[k].patch, places[k].axis}] = k;
  std::vector<Effect> effects;
  for (const Spot& spot : spots_) {
    if (!spot.evaluated) continue;
    const double s = spot.geometry.uses_stress ? spot.at.compliance : 0.0;
    const Vec2 directions[] = {spot.geometry.tangent, spot.geometry.normal};
    for (int axis = 0; axis < 2; ++axis) {
      const auto place = numbers.find({spot.patch, axis});
      if (place == numbers.end()) continue;
      for (const FaceFunction& f : spot.at.functions) {
        const Vec2 gap = (f.jump + s * f.traction).transpose() * directions[axis];
        for (LocalId k = 0; k < 2; ++k) effects.push_back({place->second, f.unknown + k, gap[k]});
      }
    }
  }
  return effects;
}

ContactSpots::Fields ContactSpots::fields(std::span<const double> state) const {
  Fields found;
  for (const Spot& spot : spots_) found.push_back(spot.at.field(spot.geometry, state));
  return found;
}

template <class Take>
double ContactSpots::sum_of_faces(const ContactPatches& patches,
                                  const std::vector<ContactAnswer>& answers, const Fields& at,
                                  const Fields& move, double share, const Take& take) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < spots_.size(); ++k) {
    const Spot& spot = spots_[k];
    if (!spot.evaluated) continue;
    const ContactAnswer& answer = answers[spot.patch];
    const ContactPatch& patch = patches.patches()[spot.patch];
    const double s = spot.geometry.uses_stress ? spot.at.compliance : 0.0;
    const auto add = [&](int axis, double spring, double stiffness, double slip, double given) {
      FaceMove face;
      face.stress = at[k].traction[axis] + share * move[k].traction[axis];
      face.gap = at[k].jump[axis] + share * move[k].jump[axis] - slip + s * face.stress;
      face.moved_stress = move[k].traction[axis];
      face.moved_gap = move[k].jump[axis] + s * face.moved_stress;
      face.compliance = (stiffness > 0.0 ? 1 / stiffness : 0.0) + spot.at.compliance;
      face.traction = spring > 0.0 ? face.gap / face.compliance : given;
      face.body = s;
      sum += spot.at.weight * take(face);
    };
    add(1, answer.normal_spring, answer.normal_spring, 0.0, 0.0);
    add(0, answer.tangential_spring, patches.law_of(patch).tangential_stiffness, patch.slip,
        answer.tangential);
  }
  return sum;
}

double ContactSpots::work(const ContactPatches& patches, const std::vector<ContactAnswer>& answers,
                          const Fields& at, const Fields& move, double share) const {
  return sum_of_faces(patches, answers, at, move, share, [](const FaceMove& f) {
    return f.traction * f.moved_gap - f.body * f.stress * f.moved_stress;
  });
}

double ContactSpots::stored(const ContactPatches& patches,
                            const std::vector<ContactAnswer>& answers, const Fields& at,
                            const Fields& move, double share) const {
  return sum_of_faces(patches, answers, at, move, share, [](const FaceMove& f) {
    return f.traction * (f.gap - 0.5 * f.compliance * f.traction) -
           0.5 * f.body * f.stress * f.stress;
  });
}

double ContactSpots::spring_work(const ContactPatches& patches, const Fields& at,
                                 const Fields& move) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < spots_.size(); ++k) {
    const Spot& spot = spots_[k];
    if (!spot.evaluated) continue;
    const ContactPatch& patch = patches.patches()[spot.patch];
    const double springs[] = {patch.now.tangential_spring, patch.now.normal_spring};
    for (int axis = 0; axis < 2; ++axis) {
      const SpringTerms terms(spot.geometry, spot.at.compliance, springs[axis]);
      const double jump = at[k].jump[axis], stress = at[k].traction[axis];
      const double moved = move[k].jump[axis], moved_stress = move[k].traction[axis];
      sum += spot.at.weight *
             (terms.jump * jump * moved + terms.mixed * (stress * moved + jump * moved_stress) -
              terms.stress * stress * moved_stress);
    }
  }
  return sum;
}

void ContactSpots::add_forces(const ContactPatches& patches, LocalId owned,
                              std::span<double> forces) const {
  for (const Spot& spot : spots_) {
    const ContactPatch& patch = patches.patches()[spot.patch];
    const double s = spot.at.compliance;
    // springs whose zeros have moved away, or along the face a given traction
    const double given = patch.now.tangential;
    const auto add = [&](double spring, double zero) {
      const SpringTerms terms(spot.geometry, s, spring);
      return Vec2(-zero * terms.jump, -zero * terms.mixed);
    };
    const Vec2 across = add(patch.now.normal_spring, patch.now.normal_zero);
    const Vec2 along =
        patch.now.tangential_spring > 0.0
            ? add(patch.now.tangential_spring, patch.slip + patch.now.tangential_zero)
            : Vec2(given, spot.geometry.uses_stress ? s * given : 0.0);
    if (across.x() == 0.0 && along.x() == 0.0) continue;
    const Vec2 by_jump = along.x() * spot.geometry.tangent + across.x() * spot.geometry.normal;
    const Vec2 by_stress = along.y() * spot.geometry.tangent + across.y() * spot.geometry.normal;
    for (const FaceFunction& f : spot.at.functions) {
      if (f.unknown >= owned) continue;
      const Vec2 force =
          -spot.at.weight * (f.jump.transpose() * by_jump + f.traction.transpose() * by_stress);
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
    if (!spot.evaluated) continue;
    const ContactPatch& patch = patches.patches()[spot.patch];
    const double stiffness = patches.law_of(patch).tangential_stiffness,
                 slip = patches.patches()[spot.patch].slip;
    if (patch.now.tangential_spring == 0.0 && stiffness > 0.0) {
      const double t = patch.now.tangential;
      sum += spot.at.weight * 0.5 * (1 / stiffness + spot.at.compliance) * t * t;
    } else if (patch.now.tangential_spring > 0.0 && slip != 0.0) {
      const SpringTerms terms(spot.geometry, spot.at.compliance, patch.now.tangential_spring);
      const auto field = spot.at.field(spot.geometry, state);
      sum += spot.at.weight * (terms.jump * (0.5 * slip * slip - slip * field.jump.x()) -
                               terms.mixed * slip * field.traction.x());
    }
  }
  return communicator.sum(sum);
}

double ContactSpots::accept(ContactPatches& patches, std::span<const double> state, double after,
                            Communicator& communicator) const {
  std::vector<double> slips(patches.patches().size(), 0.0);
  for (const Spot& spot : spots_) {
    if (!spot.evaluated) continue;
    const ContactPatch& patch = patches.patches()[spot.patch];
    slips[spot.patch] = patch.slip;
    if (patch.now.tangential_spring > 0.0) continue;
    // the spring would stand here; open faces stick where they close again
    const auto field = spot.at.field(spot.geometry, state);
    const double stiffness = patches.law_of(patch).tangential_stiffness, s = spot.at.compliance;
    double slip = field.jump.x();
    if (spot.geometry.uses_stress) slip += s * field.traction.x();
    if (stiffness > 0.0) slip -= (1 / stiffness + s) * patch.now.tangential;
    slips[spot.patch] = slip;
  }
  communicator.sum(std::span<double>(slips));
  double work = 0.0;
  for (std::size_t k = 0; k < slips.size(); ++k) {
    ContactPatch& p = patches.patches()[k];
    // faces that have opened meanwhile are not known to have rubbed
    if (p.now.state != ContactState::open)
      work +=
          p.length * ((1 - after) * p.tangential + after * p.now.tangential) * (slips[k] - p.slip);
    p.slip = slips[k];
  }
  return work;
}

void ContactSpots::find_bodies(const BodyOf& body_of, ContactPatches& patches,
                               Communicator& communicator) const {
  std::vector<double> bodies(2 * patches.patches().size(), -1.0);
  for (const Spot& spot : spots_) {
    if (!spot.evaluated) continue;
    bodies[2 * spot.patch] = body_of(spot.plus, spot.plus_part);
    bodies[2 * spot.patch + 1] = body_of(spot.minus, spot.minus_part);
  }
  communicator.max(std::span<double>(bodies));
  for (std::size_t p = 0; p < patches.patches().size(); ++p)
    patches.patches()[p].bodies = {int(bodies[2 * p]), int(bodies[2 * p + 1])};
}

}  // namespace cdca
