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

/// One tip, its frame, its cells, and the parts of elements on which its functions act: those that
/// can be reached from the tip without crossing any crack.
struct TipZone {
  int crack = 0;
  int end = 0;
  /// Growth has not joined it yet: it has K.
  bool is_active = true;
  TipFrame frame;
  std::unordered_set<GlobalId> nodes;
  /// Those of them whose near-tip functions stand in the proportions of modes I and II.
  std::unordered_set<GlobalId> with_modes;
  /// Coefficients of the four functions, x and y, in a unit of mode I and of mode II.
  std::array<Eigen::Matrix2d, 4> modes;
  std::unordered_map<GlobalId, std::vector<bool>> parts;  ///< element -> acts on part

  bool acts_on(GlobalId element, int part) const {
    const auto it = parts.find(element);
    return it != parts.end() && it->second[std::size_t(part)];
  }
};

/// Which cells get near-tip functions.
struct ZoneRule {
  double radius = 0.0;   ///< m; 0: the corners of the element of the tip only
  double kolosov = 0.0;  ///< of the material
  /// With less room than this to another crack or the rim, in elements, the field changes faster
  /// than they can follow: then cells in reach (elements) that have no near-tip functions of this
  /// tip yet take its fields of modes I and II.
  double little_room = 4.0;
  double reach_with_little_room = 5.0;
  /// Cells that more tips than this want to give their fields to take those of the nearest, and of
  /// any just as near: where tips crowd, all of them would be many unknowns for no better K. Tips
  /// that have joined do not count.
  int most_tips = 2;
};

/// The zones of all tips, the same on every rank: in order of crack and end.
///
/// A tip that growth has joined leaves its functions behind: they go on to act on all that could be
/// reached from where it was, on either side of the new crack, and of all that come later. Without
/// them the space would lose more than the new crack gives to it, and a join would give back energy
/// where it lies in a narrow neck. For the same reason their modes stay in all cells.
///
/// Cells: the corners of every element that holds the tip (also on its rim), all nodes within the
/// radius, and with little room those in reach of which at least half of the support can be reached
/// from the tip without crossing a crack. Left out are nodes whose support reaches to where the
/// functions would open uncracked material (TipFrame::valid_radius) and nodes with no part of their
/// support in reach.
std::vector<TipZone> find_tip_zones(const ElementCuts& cuts, const std::vector<Crack>& cracks,
                                    const ZoneRule& rule);

}  // namespace cdca
