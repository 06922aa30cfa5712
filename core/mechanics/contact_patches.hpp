// SPDX-License-Identifier: BSD-3-Clause
/// The patches into which crack faces are divided for contact, and their states.
#pragma once

#include "core/cells/face_stiffness.hpp"
#include "core/cracks/crack_registry.hpp"
#include "core/mechanics/contact_law.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <unordered_map>
#include <vector>

namespace cdca {

/// The crack within one element, or the half of an element's side that lies on a crack. A patch is
/// open, sticks or slips as a whole, by its mean gap.
struct ContactPatch {
  int crack = 0;
  int segment = 0;
  double from = 0.0;  ///< fractions of the segment
  double to = 1.0;
  double length = 0.0;    ///< m
  std::size_t group = 0;  ///< number of the stretch over which tractions are read
  ContactAnswer now;
  ContactGap gap;      ///< that `now` is the answer to
  double limit = 0.0;  ///< of friction, Pa: what `now` keeps to
  /// Of the last accepted equilibrium:
  double slip = 0.0;                  ///< m, that does not come back on unloading; 0 on new faces
  double largest = 0.0;               ///< m, opening so far; cohesive faces
  double tangential = 0.0;            ///< Pa
  std::array<int, 2> bodies{-1, -1};  ///< numbers of the bodies on the plus and the minus side
};

/// A stretch of one segment, about two elements long: over shorter ones the tractions show how the
/// crack lies in the elements.
struct ContactGroup {
  double length = 0.0;      ///< m
  double closed = 0.0;      ///< m of it
  double normal = 0.0;      ///< mean over the closed part, Pa
  double tangential = 0.0;  ///< the same
  double gap = 0.0;         ///< mean normal gap of the whole, m
};

/// The springs on faces, by the element that counts a face as its own.
using SpringsOfElements = std::map<GlobalId, std::vector<FaceStretch>>;
/// Elements that have faces with other springs than before, in order of id.
std::vector<GlobalId> elements_with_other_springs(const SpringsOfElements& before,
                                                  const SpringsOfElements& now);

/// All patches, the same on every rank.
class ContactPatches final : public FaceSprings {
 public:
  ContactPatches() = default;
  /// laws: by crack. Patches of segments that `previous` had take over the state and the history at
  /// their places; new segments start open where there was a previous one, touching otherwise.
  ContactPatches(const ElementCuts& cuts, const std::vector<ContactSpec>& laws,
                 const std::vector<Crack>& cracks, const ContactPatches* previous);

  bool empty() const { return patches_.empty(); }
  const std::vector<ContactPatch>& patches() const { return patches_; }
  std::vector<ContactPatch>& patches() { return patches_; }
  const ContactSpec& law_of(const ContactPatch& patch) const {
    return laws_[std::size_t(patch.crack)];
  }
  std::vector<FaceStretch> on(GridIndex element, std::size_t face) const override;
  SpringsOfElements springs() const;
  /// The patches of a face of an element, in order; a side has two.
  std::vector<std::size_t> of_face(GridIndex element, std::size_t face) const;
  /// For a restart: patches that were written down. Throws IoError where they do not fit.
  void put_back(const std::vector<ContactPatch>& patches);

  /// What all patches would answer to such gaps: by patch.
  std::vector<ContactAnswer> answers_to(const std::vector<ContactGap>& gaps) const;
  /// Of friction: those that the answers keep to, and those that follow from gaps, Pa.
  std::vector<double> limits() const;
  std::vector<double> limits_at(const std::vector<ContactGap>& gaps) const;
  /// Would all patches keep their states at such gaps and the limits that they have?
  bool settled(const std::vector<ContactGap>& gaps) const;
  /// Limits of faces that slide, as they follow from gaps; the others keep theirs.
  struct SlidingLimits {
    std::vector<double> limits;  ///< Pa
    double off = 0.0;            ///< greatest change, as a part of the largest traction
  };
  SlidingLimits limits_of_sliding(const std::vector<ContactGap>& gaps) const;
  /// Faces that slide keep to these limits from now on, Pa.
  void slide_at(const std::vector<double>& limits);
  /// What has changed in the answers of the patches.
  struct Change {
    bool springs = false;     ///< the stiffness
    double unbalanced = 0.0;  ///< largest traction that the last solve did not count with, Pa
    double at_limits = 0.0;   ///< the same where friction keeps to the limits given, Pa
    double largest = 0.0;     ///< largest traction, Pa
  };
  /// Gives all patches new gaps, and the answers to them.
  Change respond(const std::vector<ContactGap>& gaps, const std::vector<double>& limits);
  /// A face that exerts less than this (Pa) does not hold a body, after an equilibrium that is
  /// exact to the tolerance: rounding decides whether it touches at all.
  double least_holding(double tolerance) const;
  static bool holds(const ContactPatch& patch, double least);
  /// Takes the openings and tractions of this equilibrium into the history.
  void accept();

  /// Does the law of the crack know of touching?
  bool may_touch(int crack) const { return laws_[std::size_t(crack)].law != ContactLaw::none; }
  /// The patch at a place x (m) of a segment; null where there is none.
  const ContactPatch* find(int crack, int segment, const Vec2& x) const;
  const ContactGroup& group_of(const ContactPatch& patch) const { return groups_[patch.group]; }
  /// Traction on the plus face, Pa, in global axes: that of the group.
  Vec2 on_plus(const ContactPatch& patch) const;

 private:
  /// A segment of a crack with the ends that it was made with, m.
  struct Segment {
    Vec2 a{0, 0}, b{0, 0};
    std::vector<std::size_t> patches;
    double fraction(const Vec2& x) const { return (x - a).dot(b - a) / (b - a).squaredNorm(); }
  };
  using Place = std::pair<int, int>;  ///< crack, segment

  void add_face(const StructuredGrid& grid, const CrackFace& face, std::vector<std::size_t>& own);
  void group_patches(double size);
  void take_over(const ContactPatches& previous);
  void find_means();
  double unbalanced(const ContactPatch& patch, const ContactGap& gap,
                    const ContactAnswer& next) const;

  std::vector<ContactSpec> laws_;
  std::vector<ContactPatch> patches_;
  std::vector<ContactGroup> groups_;
  std::map<Place, Segment> segments_;
  /// By element: the patches of every face.
  std::unordered_map<GlobalId, std::vector<std::vector<std::size_t>>> at_;
  StructuredGrid grid_;
};

}  // namespace cdca
