// SPDX-License-Identifier: BSD-3-Clause
/// Faces that are held where they are: closed and stuck, with tractions that are given.
#pragma once

#include "core/mechanics/contact_patches.hpp"

#include <vector>

namespace cdca {

/// What the condensed body is made with, and how displacements of the whole one follow from
/// tractions that others have found. All by patch. There must be no cohesive faces.
class HeldFaces {
 public:
  /// compliances: of the body at every patch, m/Pa; softness: of the body over a length like that
  /// of a patch, m/Pa. limits: where they stay, those that the patches have now.
  HeldFaces(const ContactPatches& patches, const std::vector<double>& compliances, double softness,
            FrictionLimits limits);

  /// What all faces would answer if they were closed and stuck: no answer is stiffer.
  std::vector<ContactAnswer> closed() const;
  /// The same springs, exerting these tractions at these gaps.
  std::vector<ContactAnswer> exerting(const std::vector<FaceTraction>& tractions,
                                      const std::vector<ContactGap>& gaps) const;
  /// Tractions once faces that exert some at `from` have come to `to`.
  std::vector<FaceTraction> at(const std::vector<ContactGap>& to,
                               std::vector<FaceTraction> tractions,
                               const std::vector<ContactGap>& from) const;
  /// The largest difference between a traction and what the laws answer to such gaps, as a part of
  /// the largest traction; where all faces are open, of what would close the widest.
  double unbalanced(const std::vector<FaceTraction>& tractions,
                    const std::vector<ContactGap>& gaps) const;

 private:
  struct Face {
    std::size_t patch = 0;
    ContactSpec spec;
    double body = 0.0;    ///< compliance, m/Pa
    double given = -1.0;  ///< limit that stays, Pa; less than 0: it follows the pressure
  };
  std::size_t patches_ = 0;  ///< number of them; those without a law are no faces
  std::vector<Face> faces_;
  double softness_;  ///< m/Pa
};

}  // namespace cdca
