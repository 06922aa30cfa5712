// SPDX-License-Identifier: BSD-3-Clause
/// Contact between the faces of the elements of one rank (2.3, and step 5 of 2.4.3).
#pragma once

#include "core/mechanics/contact_patches.hpp"

#include <compare>
#include <functional>
#include <map>
#include <vector>

namespace cdca {

/// The places where the springs of the patches act, with what the faces have slipped at each.
class ContactSpots {
 public:
  /// A segment of a crack, known by its ends (m), which growth does not change.
  struct Segment {
    double crack, ax, ay, bx, by;
    auto operator<=>(const Segment&) const = default;
  };
  /// Slip that does not come back on unloading, over a stretch of a segment.
  struct Slip {
    Segment segment{};
    double from = 0.0;  ///< fractions of the segment
    double to = 0.0;
    double slip = 0.0;  ///< m, zero on new faces
    auto operator<=>(const Slip&) const = default;
  };
  using Slips = std::map<Segment, std::vector<Slip>>;
  static Slips by_segment(const std::vector<Slip>& slips);

  ContactSpots() = default;
  /// The spots of all elements that this rank holds; slips: of faces that were there before.
  ContactSpots(const BasisContext& context, const std::vector<Crack>& cracks,
               const ContactPatches& patches, const ElasticMatrix& elastic, const Slips& slips);

  /// Sets the mean gaps of all patches from a state (with ghosts). Collective.
  void measure(std::span<const double> state, ContactPatches& patches,
               Communicator& communicator) const;
  /// Adds the nodal forces of given tractions, and of springs that have slipped, on own cells.
  void add_forces(const ContactPatches& patches, LocalId owned, std::span<double> forces) const;
  /// Stored in springs less what u K u / 2 counts for them, J per metre of thickness. Collective.
  double energy_correction(const ContactPatches& patches, std::span<const double> state,
                           Communicator& communicator) const;
  /// The faces have slipped as far as this state says. Returns the work that has gone into friction
  /// since the last time, J per metre of thickness. Collective.
  double accept(const ContactPatches& patches, std::span<const double> state,
                Communicator& communicator);

  /// Of the elements that this rank holds.
  Slips slips() const;
  /// Of the whole body, the same on every rank. Collective.
  std::vector<Slip> all_slips(Communicator& communicator) const;

  /// Sets the bodies on the sides of every patch. body_of(element, part): number, asked for
  /// elements that this rank evaluates. Collective.
  using BodyOf = std::function<int(GridIndex element, int part)>;
  void find_bodies(const BodyOf& body_of, ContactPatches& patches,
                   Communicator& communicator) const;

 private:
  struct Face {
    FaceGeometry geometry;
    GridIndex plus, minus;  ///< elements
    int plus_part, minus_part;
    Segment segment;
    bool evaluated;  ///< by this rank
  };
  struct Spot {
    std::size_t face;
    std::size_t patch;
    Slip slip;
    FaceSpot at;
  };
  /// The part of the jump that a sticking spring feels.
  static double stretched(const Spot& spot, const FaceSpot::Field& field) {
    return field.jump.x() - spot.slip.slip;
  }
  void add_face(const BasisContext& context, const std::vector<Crack>& cracks,
                const ContactPatches& patches, const ElasticMatrix& elastic, const Slips& slips,
                const CrackFace& face, bool evaluated);

  std::vector<Face> faces_;
  std::vector<Spot> spots_;
};

}  // namespace cdca
