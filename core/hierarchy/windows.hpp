// SPDX-License-Identifier: BSD-3-Clause
/// Exact solves for the cells near cracks, one colour of windows after the other.
#pragma once

#include "core/cells/carried_cells.hpp"
#include "core/hierarchy/window_factors.hpp"
#include "core/hierarchy/window_plan.hpp"

#include <map>
#include <memory>

namespace cdca {

/// The windows of one scale. Each is solved by one rank, also where it holds cells of others: these
/// send their forces and receive their moves, so that the result does not depend on the ranks.
class Windows {
 public:
  /// cells must have rows for all cells of windows. before, carried: the windows of before the
  /// cracks grew, and what has stayed as it was; null for none. Collective.
  Windows(const WindowPlans& plans, const LocalMesh& mesh, const CellUnknowns& unknowns,
          const CellStiffness& cells, WindowFactors& factors, const Windows* before = nullptr,
          const CarriedCells* carried = nullptr);

  /// Brings the windows of each colour into equilibrium, from the first colour to the last or the
  /// other way round: moves are added, forces brought up to date. Collective.
  void move(SweepDirection direction, std::span<double> forces, std::span<double> moves) const;

 private:
  /// What a cell of the window does to a cell outside.
  struct Coupling {
    LocalId outside;
    int member;
    double value;
  };
  /// This rank's share of one window.
  struct Share {
    std::vector<LocalId> members;  ///< own free unknowns
    std::vector<Coupling> couplings;
  };
  /// A window that this rank solves: its own members first, then those of others, rank by rank.
  struct Solved {
    std::size_t share;                                        ///< this rank's own
    std::vector<std::pair<std::size_t, std::size_t>> remote;  ///< place and number of what comes in
    std::size_t size = 0;
    WindowFactors::Found found;  ///< no factor where all is held
  };
  /// Values that go from shares to solving ranks; the moves come back the same way.
  struct Colour {
    std::vector<Solved> solved;
    std::vector<std::size_t> sent;  ///< shares, in the order of the values sent
    std::vector<int> ranks;
    std::vector<std::size_t> send_offsets{0};
    std::vector<std::size_t> receive_offsets{0};
    bool near_border = false;  ///< some rank's cells outside the windows are touched from another
  };
  class Builder;  ///< windows_build.cpp

  void move_colour(const Colour& colour, std::span<double> forces, std::span<double> moves) const;
  void apply(const Share& share, const double* move, std::span<double> forces,
             std::span<double> moves) const;

  const CellStiffness& cells_;
  std::vector<Share> shares_;
  std::vector<Colour> colours_;
  /// Of windows that this rank has all to itself, by their nodes: colour, and place in it.
  std::map<std::vector<GlobalId>, std::pair<std::size_t, std::size_t>> own_;
};

}  // namespace cdca
