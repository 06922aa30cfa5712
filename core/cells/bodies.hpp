// SPDX-License-Identifier: BSD-3-Clause
/// Connected bodies of pieces, and whether each of them is held.
#pragma once

#include "core/cells/part_basis.hpp"

#include <cstdint>
#include <vector>

namespace cdca {

/// A connected set of pieces of cells.
struct Body {
  Vec2 at{0, 0};  ///< m, a place in it
  std::int64_t pieces = 0;
  bool held = false;        ///< its supports stop all three rigid motions
  std::uint64_t marks = 0;  ///< of all its pieces
};

/// What touches a piece, one bit for everything.
struct PieceMarks {
  LocalId node = 0;
  int piece = 0;
  std::uint64_t bits = 0;
};

/// All bodies of the grid, the same list on every rank whoever owns what, and which of them the
/// pieces of this rank belong to.
class Bodies {
 public:
  /// held: per unknown, as supports prescribe it. marks: those of own cells count. Collective.
  Bodies(const BasisContext& context, const std::vector<char>& held,
         const std::vector<PieceMarks>& marks, Communicator& communicator);

  const std::vector<Body>& list() const { return list_; }
  std::size_t body_of(LocalId node, int piece) const {
    return of_vertex_[std::size_t(first_[std::size_t(node)] + piece)];
  }

 private:
  std::vector<Body> list_;
  std::vector<std::int32_t> first_;     ///< vertex of every node's first piece
  std::vector<std::size_t> of_vertex_;  ///< body of every vertex
};

}  // namespace cdca
