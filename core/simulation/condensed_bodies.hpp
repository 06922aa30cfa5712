// SPDX-License-Identifier: BSD-3-Clause
/// The body condensed to the faces of its cracks, for the last few kinds of springs in it.
#pragma once

#include "core/mechanics/contact_spots.hpp"
#include "core/mechanics/reference_faces.hpp"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <vector>

namespace cdca {

struct FacesOfBody {
  std::vector<SpringPlace> places;
  double weak_share = 0.0;     ///< of weak springs, as a part of the cells' own stiffness
  bool all_held = false;       ///< by those: not only loose bodies
  Eigen::MatrixXd compliance;  ///< with closed faces, m^2/N; on the first rank
  ReferenceFaces reference;    ///< empty at first
};

class CondensedBodies {
 public:
  /// That with such places and weak springs, whose compliance is made where it is not kept.
  FacesOfBody& of(FacesOfBody wanted, const std::function<Eigen::MatrixXd()>& make);
  /// The cells are no longer the same.
  void clear() { kept_.clear(); }

 private:
  std::vector<std::unique_ptr<FacesOfBody>> kept_;  ///< used last first
};

}  // namespace cdca
