// SPDX-License-Identifier: BSD-3-Clause
/// The patches into which crack faces are divided for contact, and their states.
#pragma once

#include "core/cells/face_stiffness.hpp"
#include "core/cracks/crack_registry.hpp"
#include "core/mechanics/contact_law.hpp"

#include <array>
#include <map>
#include <vector>

namespace cdca {

/// A stretch of one segment of a crack, about two elements long: over shorter ones the tractions
/// still show how the crack lies in the elements. Its state follows from the mean gap on it.
struct ContactPatch {
  int crack = 0;
  int segment = 0;
  double from = 0.0;  ///< fractions of the segment
  double to = 1.0;
  double length = 0.0;  ///< m
  ContactAnswer now;
  ContactGap gap;  ///< that `now` is the answer to
  /// Of the last accepted equilibrium:
  double largest = 0.0;               ///< m, opening so far; cohesive faces
  double tangential = 0.0;            ///< Pa
  std::array<int, 2> bodies{-1, -1};  ///< numbers of the bodies on the plus and the minus side
};

/// All patches, the same on every rank.
class ContactPatches final : public FaceSprings {
 public:
  /// The part of a face that lies in one patch, in fractions of the face.
  struct Share {
    std::size_t patch;
    double from, to;
  };

  ContactPatches() = default;
  /// laws: by crack. Patches of segments that `previous` had keep their state; new segments start
  /// open where there was a previous one, touching otherwise.
  ContactPatches(const StructuredGrid& grid, const std::vector<ContactSpec>& laws,
                 const std::vector<Crack>& cracks, const ContactPatches* previous);

  /// Takes over history and answers of the same patches. Throws IoError when they are others.
  void put_back(const std::vector<ContactPatch>& patches);

  bool empty() const { return patches_.empty(); }
  const std::vector<ContactPatch>& patches() const { return patches_; }
  std::vector<ContactPatch>& patches() { return patches_; }
  const ContactSpec& law_of(const ContactPatch& patch) const {
    return laws_[std::size_t(patch.crack)];
  }
  std::vector<FaceStretch> on(const CrackFace& face) const override;
  std::vector<Share> shares(const CrackFace& face) const;
  /// Place of a point of a segment along it, from 0 to 1.
  double fraction(int crack, int segment, const Vec2& x) const;

  /// What has changed in the answers of the patches.
  struct Change {
    bool springs = false;   ///< the stiffness
    double traction = 0.0;  ///< largest change of a given traction, Pa
    double largest = 0.0;   ///< largest traction, Pa
  };
  /// Gives all patches new answers to their gaps.
  Change respond();
  /// Takes the openings and tractions of this equilibrium into the history.
  void accept();

  bool touches(const CrackFace& face) const { return run_of(face.crack, face.segment); }
  /// Traction on the plus face at a place of a segment, Pa, in global axes.
  Vec2 on_plus(int crack, int segment, const Vec2& x) const;
  const ContactPatch* find(int crack, int segment, const Vec2& x) const;

 private:
  struct Run {
    std::size_t first = 0;
    std::size_t count = 0;
    Vec2 a{0, 0}, b{0, 0};  ///< ends of the segment, m
    double fraction(const Vec2& x) const { return (x - a).dot(b - a) / (b - a).squaredNorm(); }
  };
  const Run* run_of(int crack, int segment) const;

  StructuredGrid grid_;
  std::vector<ContactSpec> laws_;
  std::vector<ContactPatch> patches_;
  std::map<std::pair<int, int>, Run> runs_;
};

}  // namespace cdca
