// SPDX-License-Identifier: BSD-3-Clause
/// Contact between the faces of the elements of one rank (2.3, and step 5 of 2.4.3).
#pragma once

#include "core/base/effect.hpp"
#include "core/mechanics/contact_patches.hpp"

#include <functional>
#include <vector>

namespace cdca {

/// A direction of a patch in which it has a spring.
struct SpringPlace {
  std::size_t patch = 0;
  int axis = 0;             ///< 0: along the face, 1: across
  double length = 0.0;      ///< over which it acts, m
  double compliance = 0.0;  ///< of the body in the gap, m/Pa
  double stiffness = 0.0;   ///< of the spring, Pa/m
  /// Of a spring and the body in a row, Pa/m.
  double with_body(double spring) const { return spring > 0.0 ? 1 / (1 / spring + compliance) : 0; }

  bool operator==(const SpringPlace&) const = default;
};

/// The places where the springs of the patches act, one for each.
class ContactSpots {
 public:
  ContactSpots() = default;
  /// The spots of all elements that this rank holds.
  ContactSpots(const BasisContext& context, const ContactPatches& patches,
               const ElasticMatrix& elastic);

  /// The mean gaps of all patches in a state (with ghosts), as springs of the patches' present
  /// answers feel them. Linear in the state. Collective.
  std::vector<ContactGap> gaps(std::span<const double> state, const ContactPatches& patches,
                               Communicator& communicator) const;

  /// Compliance of the body at every patch, where it takes part in the patch's gap, m/Pa.
  /// Collective.
  std::vector<double> compliances(const ContactPatches& patches, Communicator& communicator) const;

  /// Where patches that answer so have springs. Collective.
  std::vector<SpringPlace> spring_places(const std::vector<ContactAnswer>& answers,
                                         const ContactPatches& patches,
                                         Communicator& communicator) const;
  /// What this rank's unknowns do to the gaps at these places with the body's share, m.
  std::vector<Effect> effects_on(const std::vector<SpringPlace>& places) const;

  /// Jump and stress at every spot.
  using Fields = std::vector<FaceSpot::Field>;
  Fields fields(std::span<const double> state) const;
  /// Work of the contact forces in the state `at` + `share` times `move` on `move`, of this rank's
  /// spots, J per metre of thickness: what faces with these answers exert.
  double work(const ContactPatches& patches, const std::vector<ContactAnswer>& answers,
              const Fields& at, const Fields& move, double share) const;
  /// What faces with these answers have stored in that state, friction as if it gave its work back;
  /// J per metre of thickness. `work` is its derivative.
  double stored(const ContactPatches& patches, const std::vector<ContactAnswer>& answers,
                const Fields& at, const Fields& move, double share) const;
  /// The same of what the stiffness counts: springs as if nothing had slipped.
  double spring_work(const ContactPatches& patches, const Fields& at, const Fields& move) const;

  /// Adds the nodal forces of given tractions, and of springs that have slipped, on own cells.
  void add_forces(const ContactPatches& patches, LocalId owned, std::span<double> forces) const;
  /// Stored in springs less what u K u / 2 counts for them, J per metre of thickness. Collective.
  double energy_correction(const ContactPatches& patches, std::span<const double> state,
                           Communicator& communicator) const;
  /// The faces have slipped as far as this state says. Returns the work that has gone into friction
  /// since the last time, J per metre of thickness. after: the part in it of the tractions of now;
  /// the rest is that of the last time. Collective.
  double accept(ContactPatches& patches, std::span<const double> state, double after,
                Communicator& communicator) const;

  /// Sets the bodies on the sides of every patch. body_of(element, part): number, asked for
  /// elements that this rank evaluates. Collective.
  using BodyOf = std::function<int(GridIndex element, int part)>;
  void find_bodies(const BodyOf& body_of, ContactPatches& patches,
                   Communicator& communicator) const;

 private:
  struct Spot {
    std::size_t patch;
    FaceGeometry geometry;
    FaceSpot at;
    GridIndex plus, minus;  ///< elements
    int plus_part, minus_part;
    bool evaluated;  ///< by this rank
  };

  /// One direction of a spot on a move, and what its face exerts there.
  struct FaceMove {
    double traction;                 ///< Pa
    double gap, stress;              ///< m, with the body's share, and Pa
    double moved_gap, moved_stress;  ///< the same of the move
    double compliance;               ///< of the spring and the body, m/Pa
    double body;                     ///< of the body alone
  };
  template <class Take>
  double sum_of_faces(const ContactPatches& patches, const std::vector<ContactAnswer>& answers,
                      const Fields& at, const Fields& move, double share, const Take& take) const;

  std::vector<Spot> spots_;
};

}  // namespace cdca
