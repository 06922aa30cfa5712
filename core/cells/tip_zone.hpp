// SPDX-License-Identifier: BSD-3-Clause
/// The surroundings of a crack tip in which cells carry near-tip functions.
#pragma once

#include "core/cells/element_cuts.hpp"
#include "core/cells/near_tip.hpp"
#include "core/cracks/crack_registry.hpp"

#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace cdca {

/// One active tip, its frame, its cells, and the parts of elements on which its functions act:
/// those that can be reached from the tip without crossing any crack.
struct TipZone {
  int crack = 0;
  int end = 0;
  TipFrame frame;
  std::unordered_set<GlobalId> nodes;
  std::unordered_map<GlobalId, std::vector<bool>> parts;  ///< element -> acts on part

  bool acts_on(GlobalId element, int part) const {
    const auto it = parts.find(element);
    return it != parts.end() && it->second[std::size_t(part)];
  }
};

/// The zones of all active tips, the same on every rank: in order of crack and end.
///
/// Cells: the corners of every element that holds the tip (also on its rim), and all nodes within
/// tip_radius (m). Left out are nodes whose support reaches to where the functions would open
/// uncracked material (TipFrame::valid_radius) and nodes with no part of their support in reach.
std::vector<TipZone> find_tip_zones(const ElementCuts& cuts, const std::vector<Crack>& cracks,
                                    double tip_radius);

}  // namespace cdca
