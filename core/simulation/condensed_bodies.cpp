// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/condensed_bodies.hpp"

#include <algorithm>
#include <utility>

namespace cdca {

FacesOfBody& CondensedBodies::of(FacesOfBody wanted, const std::function<Eigen::MatrixXd()>& make) {
  constexpr std::size_t most = 3;  // they are large
  const auto same = std::find_if(kept_.begin(), kept_.end(), [&](const auto& known) {
    return known->places == wanted.places && known->all_held == wanted.all_held &&
           known->weak_share == wanted.weak_share;
  });
  if (same != kept_.end()) {
    std::rotate(kept_.begin(), same, same + 1);
    return *kept_.front();
  }
  wanted.compliance = make();
  kept_.insert(kept_.begin(), std::make_unique<FacesOfBody>(std::move(wanted)));
  kept_.resize(std::min(most, kept_.size()));
  return *kept_.front();
}

}  // namespace cdca
