// SPDX-License-Identifier: BSD-3-Clause
/// An element cut by cracks: its parts, its open and closed sides, and the crack faces inside it.
#pragma once

#include "core/cracks/crack_paths.hpp"

#include <array>
#include <optional>
#include <vector>

namespace cdca {

/// A stretch of an element side, from t0 to t1 in the direction of growing x or y, in element
/// sizes.
struct SidePortion {
  double t0 = 0.0;
  double t1 = 1.0;
  int part = 0;
  bool closed = false;  ///< a crack lies between this stretch and the neighbour element
  int step = -1;        ///< of those in the element: the one that closes it
  bool sliver = false;  ///< closed because a sliver here has joined the part across the crack
};

/// A straight bit of crack between two parts of one element; the same part on both sides near a
/// tip.
struct InnerFace {
  Vec2 from{0, 0};  ///< inside the element, [0, 1]
  Vec2 to{0, 0};
  int step = 0;  ///< of the crack paths
  int plus = 0;  ///< part on the left of the crack's direction
  int minus = 0;
};

/// A polygon of the element; a part is made of one or several.
struct ElementPolygon {
  std::vector<Vec2> loop;  ///< inside the element, counter-clockwise
  int part = 0;
  double area = 0.0;  ///< in element areas
  /// Set for a sliver that has joined the part across the crack: a place close to it on that side.
  std::optional<Vec2> continues;
};

/// Sides are numbered 0 bottom, 1 right, 2 top, 3 left.
struct CutElement {
  int parts = 1;
  std::vector<ElementPolygon> polygons;
  std::array<std::vector<SidePortion>, 4> sides;
  std::vector<InnerFace> faces;

  /// The part that holds a point inside the element.
  int part_at(const Vec2& p) const;
  /// A place well inside the largest polygon of a part.
  Vec2 place_in(int part) const;
};

/// Polygons smaller than this, in element areas, join the part across the crack that has the
/// longest common face with them: the crack then runs round them along the element's sides.
/// So no piece of a cell is ever too small to be well conditioned, and rigid motions of the parts
/// and constant strain stay exact.
constexpr double smallest_polygon = 1e-4;

CutElement cut_element(const CrackPaths& paths, GridIndex element);

/// Is p inside (or on the rim of) the polygon?
bool contains(const std::vector<Vec2>& loop, const Vec2& p);

/// A stretch of the side between two elements where both are known.
struct SideContact {
  double t0 = 0.0;
  double t1 = 1.0;
  int first = 0;   ///< part of the first element
  int second = 0;  ///< part of the second element
  bool open = true;
  int step = -1;  ///< of those in one of the elements: the one that closes it, if known
  bool step_of_second = false;
  bool between_slivers = false;
};

/// Lays the portions of a common side over each other.
std::vector<SideContact> contacts(const std::vector<SidePortion>& first,
                                  const std::vector<SidePortion>& second);

}  // namespace cdca
