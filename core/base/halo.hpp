// SPDX-License-Identifier: BSD-3-Clause
/// The exchange of neighbour values along rank borders.
#pragma once

#include "core/base/communicator.hpp"
#include "core/base/types.hpp"

#include <span>
#include <vector>

namespace cdca {

/// The unknowns that this rank shares with one other rank, in an order that both sides know.
struct SharedUnknowns {
  int rank = 0;
  std::vector<LocalId> owned;   ///< mine, ghosts there
  std::vector<LocalId> ghosts;  ///< ghosts here, owned there
};

/// Sends nodal forces to the owners of ghost cells, and states of own cells to their ghosts.
class Halo {
 public:
  Halo() = default;
  Halo(Communicator& communicator, std::vector<SharedUnknowns> shared);

  /// The one message of a solve: forces on ghosts are added to the owner's, and cleared here.
  void add_forces(std::span<double> values) const;
  /// Owner's values overwrite the ghosts'; used only where elements are evaluated.
  void copy_state(std::span<double> values) const;
  /// The ghosts whose owners have set a flag.
  std::vector<LocalId> ghosts_of(std::span<const char> flags) const;

 private:
  void send_to_ghosts() const;

  Communicator* communicator_ = nullptr;
  std::vector<int> ranks_;
  std::vector<LocalId> owned_;
  std::vector<LocalId> ghosts_;
  std::vector<std::size_t> owned_offsets_{0};
  std::vector<std::size_t> ghost_offsets_{0};
  mutable std::vector<double> owned_buffer_;
  mutable std::vector<double> ghost_buffer_;
};

}  // namespace cdca
