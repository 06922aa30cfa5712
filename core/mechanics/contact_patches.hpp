// SPDX-License-Identifier: BSD-3-Clause
/// Contact on all crack faces, patch by patch (2.3, and steps 5-7 of 2.4.3).
#pragma once

#include "core/cells/face_stiffness.hpp"
#include "core/cracks/crack_registry.hpp"
#include "core/mechanics/contact_law.hpp"

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace cdca {

/// A stretch of one segment of a crack, about an element long. Its state follows from the mean gap
/// on it; inside a closed patch the springs act at every place.
struct ContactPatch {
  int crack = 0;
  int segment = 0;
  double from = 0.0;  ///< fractions of the segment
  double to = 1.0;
  double length = 0.0;     ///< m
  ContactHistory history;  ///< of the last accepted equilibrium
  ContactAnswer now;
  /// Gap of the springs alone, m: (tangential, normal); of a closed patch, that which its mean
  /// traction belongs to.
  Vec2 gap{0, 0};
  std::array<int, 2> bodies{};  ///< numbers of the bodies on the plus and the minus side
};

/// All patches, the same on every rank.
class ContactPatches final : public FaceSprings {
 public:
  ContactPatches() = default;
  /// laws: by crack. Patches of segments that `previous` had keep their state; new segments start
  /// open where there was a previous one, touching otherwise.
  ContactPatches(const StructuredGrid& grid, const ElasticMatrix& elastic,
                 const std::vector<ContactSpec>& laws, const std::vector<Crack>& cracks,
                 const ContactPatches* previous);

  /// Takes over history and answers of the same patches. Throws IoError when they are others.
  void put_back(const std::vector<ContactPatch>& patches);

  bool empty() const { return patches_.empty(); }
  const std::vector<ContactPatch>& patches() const { return patches_; }
  std::vector<FaceStretch> on(const CrackFace& face) const override;

  /// Mean gaps of a state (with ghosts). Collective.
  void measure(const BasisContext& context, std::span<const double> state,
               Communicator& communicator);
  /// What the patches answer to their gaps.
  struct Change {
    bool springs = false;   ///< the stiffness has changed
    double traction = 0.0;  ///< largest change of a given traction, Pa
    double largest = 0.0;   ///< largest traction, Pa
  };
  Change respond();
  /// Takes the slip and the openings of this equilibrium into the history.
  void accept();

  /// Adds the nodal forces of tractions that are given, not springs: on own cells.
  void add_forces(const BasisContext& context, std::span<double> forces) const;
  bool touches(const CrackFace& face) const { return run_of(face.crack, face.segment); }
  /// Traction on the plus face at a place of a segment, Pa, in global axes.
  Vec2 on_plus(int crack, int segment, const Vec2& x) const;
  const ContactPatch* find(int crack, int segment, const Vec2& x) const;

  /// Stored in springs less what u K u / 2 counts for them, J per metre of thickness. Collective.
  double energy_correction(const BasisContext& context, std::span<const double> state,
                           Communicator& communicator) const;
  /// Work against friction from the last accepted equilibrium to this one, J per metre.
  double friction_work() const;

  /// Sets the bodies on the sides of every patch. body_of(element, part): number, asked for
  /// elements that this rank evaluates. Collective.
  using BodyOf = std::function<int(GridIndex element, int part)>;
  void find_bodies(const BasisContext& context, const BodyOf& body_of, Communicator& communicator);

 private:
  struct Run {
    std::size_t first = 0;
    std::size_t count = 0;
    Vec2 a{0, 0}, b{0, 0};  ///< ends of the segment, m
    double fraction(const Vec2& x) const { return (x - a).dot(b - a) / (b - a).squaredNorm(); }
  };
  /// The part of a face that lies in one patch, in fractions of the face.
  struct Share {
    std::size_t patch;
    double from, to;
  };
  std::vector<Share> shares(const CrackFace& face) const;
  /// Calls visit(face basis, share) for the faces of all elements that pass.
  template <class Pass, class Visit>
  void for_faces(const BasisContext& context, Pass pass, Visit visit) const;
  const Run* run_of(int crack, int segment) const;

  StructuredGrid grid_;
  ElasticMatrix elastic_;
  std::vector<ContactSpec> laws_;
  std::vector<ContactPatch> patches_;
  std::map<std::pair<int, int>, Run> runs_;
};

}  // namespace cdca
