// SPDX-License-Identifier: BSD-3-Clause
/// The body condensed to its faces: all that faces need to know of it to settle.
#pragma once

#include "core/base/dense_factor.hpp"
#include "core/mechanics/contact_spots.hpp"

#include <vector>

namespace cdca {

/// Gaps under given loads for any springs that are no stiffer than those of the laws. With G u the
/// gaps, w lengths, and k0 the springs of the laws, the body with all faces closed has
///
///     (K + G^T w k0 G) u0 = f,    C = G (K + G^T w k0 G)^-1 G^T,
///
/// and with springs k that exert nothing at gaps z
///
///     g = G u0 + C w ((k0 - k) g + k z).
///
/// Closed faces hold all loose bodies, so that C is exact; k0 - k is 0 for faces that stay closed.
class BodyAtFaces {
 public:
  /// compliance: C, m^2/N by place, needed on the first rank only; closed: the gaps of all patches
  /// with closed faces under the loads. All are borrowed.
  BodyAtFaces(const std::vector<SpringPlace>& places, const Eigen::MatrixXd& compliance,
              const std::vector<ContactGap>& closed, Communicator& communicator);
  /// With these answers of all patches, on every rank what the first one finds: those that decide
  /// by it must not differ by their rounding. Throws SolveError where the answers hold the body too
  /// weakly. Collective.
  std::vector<ContactGap> gaps(const std::vector<ContactAnswer>& answers);

 private:
  /// Empty where there is no factor.
  std::vector<ContactGap> found(const std::vector<ContactAnswer>& answers);
  /// Returns whether there is a factor.
  bool set_springs(const Eigen::VectorXd& springs);

  const std::vector<SpringPlace>& places_;
  const Eigen::MatrixXd& compliance_;
  const std::vector<ContactGap>& closed_;
  Communicator& communicator_;
  Eigen::VectorXd springs_;  ///< k that the factor is for, Pa/m
  Eigen::VectorXd roots_;    ///< of w (k0 - k)
  DenseFactor factor_;
};

}  // namespace cdca
