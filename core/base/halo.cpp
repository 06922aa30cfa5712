// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/halo.hpp"

namespace cdca {

Halo::Halo(Communicator& communicator, std::vector<SharedUnknowns> shared)
    : communicator_(&communicator) {
  for (const SharedUnknowns& s : shared) {
    ranks_.push_back(s.rank);
    owned_.insert(owned_.end(), s.owned.begin(), s.owned.end());
    ghosts_.insert(ghosts_.end(), s.ghosts.begin(), s.ghosts.end());
    owned_offsets_.push_back(owned_.size());
    ghost_offsets_.push_back(ghosts_.size());
  }
  owned_buffer_.resize(owned_.size());
  ghost_buffer_.resize(ghosts_.size());
}

void Halo::add_forces(std::span<double> values) const {
  if (ranks_.empty()) return;
  for (std::size_t k = 0; k < ghosts_.size(); ++k) {
    ghost_buffer_[k] = values[std::size_t(ghosts_[k])];
    values[std::size_t(ghosts_[k])] = 0.0;
  }
  communicator_->exchange_values(ranks_, ghost_buffer_, ghost_offsets_, owned_buffer_,
                                 owned_offsets_);
  for (std::size_t k = 0; k < owned_.size(); ++k)
    values[std::size_t(owned_[k])] += owned_buffer_[k];
}

void Halo::send_to_ghosts() const {
  communicator_->exchange_values(ranks_, owned_buffer_, owned_offsets_, ghost_buffer_,
                                 ghost_offsets_);
}

void Halo::copy_state(std::span<double> values) const {
  if (ranks_.empty()) return;
  for (std::size_t k = 0; k < owned_.size(); ++k) owned_buffer_[k] = values[std::size_t(owned_[k])];
  send_to_ghosts();
  for (std::size_t k = 0; k < ghosts_.size(); ++k) {
    values[std::size_t(ghosts_[k])] = ghost_buffer_[k];
  }
}

std::vector<LocalId> Halo::ghosts_of(std::span<const char> flags) const {
  std::vector<LocalId> found;
  if (ranks_.empty()) return found;
  for (std::size_t k = 0; k < owned_.size(); ++k) owned_buffer_[k] = flags[std::size_t(owned_[k])];
  send_to_ghosts();
  for (std::size_t k = 0; k < ghosts_.size(); ++k) {
    if (ghost_buffer_[k] != 0.0) found.push_back(ghosts_[k]);
  }
  return found;
}

}  // namespace cdca
