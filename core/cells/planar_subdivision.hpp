// SPDX-License-Identifier: BSD-3-Clause
/// The planar arrangement of crack steps inside one element.
#pragma once

#include "core/base/types.hpp"

#include <array>
#include <vector>

namespace cdca {

/// A straight line inside the unit square, with the number that its maker gave it.
struct TaggedSegment {
  Vec2 from{0, 0};
  Vec2 to{0, 0};
  int tag = 0;
};

/// An edge of the arrangement. Faces are polygons, -1 outside the square.
struct SubdivisionEdge {
  int a = 0;
  int b = 0;
  int tag = 0;  ///< of a segment, or one of the two below
  int left = -1;
  int right = -1;
};

/// The unit square split by segments. Segments that end in the open are prolonged straight on by
/// virtual edges, so that every face is a simple polygon without slits and every loose end a
/// corner.
class PlanarSubdivision {
 public:
  static constexpr int rim = -1;        ///< tag of edges on the rim of the square
  static constexpr int prolonged = -2;  ///< tag of virtual edges

  explicit PlanarSubdivision(const std::vector<TaggedSegment>& segments);

  const std::vector<Vec2>& vertices() const { return vertices_; }
  const std::vector<SubdivisionEdge>& edges() const { return edges_; }
  /// Corners of each face, counter-clockwise.
  const std::vector<std::vector<int>>& polygons() const { return polygons_; }
  double area(std::size_t polygon) const;
  std::vector<Vec2> loop(std::size_t polygon) const;

 private:
  int vertex_at(const Vec2& p);
  void add_segments(const std::vector<TaggedSegment>& segments);
  void add_edge(int a, int b, int tag);
  void split_edge(std::size_t edge, int vertex);
  void prolong_loose_ends();
  void tie_islands();
  void shoot(int from, const Vec2& direction);
  void add_rim();
  void trace();

  std::vector<Vec2> vertices_;
  std::vector<SubdivisionEdge> edges_;
  std::vector<std::vector<int>> polygons_;
};

}  // namespace cdca
