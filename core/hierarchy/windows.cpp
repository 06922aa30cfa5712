// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/windows.hpp"

namespace cdca {

void Windows::move(SweepDirection direction, std::span<double> forces,
                   std::span<double> moves) const {
  const bool forward = direction == SweepDirection::forward;
  for (std::size_t c = 0; c < colours_.size(); ++c) {
    move_colour(colours_[forward ? c : colours_.size() - 1 - c], forces, moves);
  }
}

void Windows::apply(const Share& share, const double* move, std::span<double> forces,
                    std::span<double> moves) const {
  for (std::size_t m = 0; m < share.members.size(); ++m) {
    moves[std::size_t(share.members[m])] += move[m];
    forces[std::size_t(share.members[m])] = 0.0;
  }
  for (const Coupling& c : share.couplings)
    forces[std::size_t(c.outside)] -= c.value * move[c.member];
}

void Windows::move_colour(const Colour& colour, std::span<double> forces,
                          std::span<double> moves) const {
  Communicator& communicator = cells_.communicator();
  std::vector<double> sent, received(colour.receive_offsets.back());
  for (const std::size_t s : colour.sent) {
    for (const LocalId u : shares_[s].members) sent.push_back(forces[std::size_t(u)]);
  }
  if (!colour.ranks.empty()) {
    communicator.exchange_values(colour.ranks, sent, colour.send_offsets, received,
                                 colour.receive_offsets);
  }
  Eigen::VectorXd force, move;
  for (const Solved& window : colour.solved) {
    if (!window.found.factor) continue;
    const Share& share = shares_[window.share];
    const Eigen::VectorXi& place = window.found.factor->place;
    force.resize(Eigen::Index(window.size));
    Eigen::Index at = 0;
    for (const LocalId u : share.members) force[place[at++]] = forces[std::size_t(u)];
    for (const auto& [start, count] : window.remote) {
      for (std::size_t k = 0; k < count; ++k) force[place[at++]] = received[start + k];
    }
    force = window.found.factor->factor.solve(force).eval();
    move.resize(force.size());
    for (Eigen::Index k = 0; k < place.size(); ++k) move[k] = force[place[k]];
    apply(share, move.data(), forces, moves);
    at = Eigen::Index(share.members.size());
    for (const auto& [start, count] : window.remote) {
      for (std::size_t k = 0; k < count; ++k) received[start + k] = move[at++];
    }
  }
  if (!colour.ranks.empty()) {
    communicator.exchange_values(colour.ranks, received, colour.receive_offsets, sent,
                                 colour.send_offsets);
  }
  std::size_t at = 0;
  for (const std::size_t s : colour.sent) {
    apply(shares_[s], sent.data() + at, forces, moves);
    at += shares_[s].members.size();
  }
  if (colour.near_border) cells_.halo().add_forces(forces);
}

}  // namespace cdca
