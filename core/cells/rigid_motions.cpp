// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/rigid_motions.hpp"

#include <algorithm>

namespace cdca {

namespace {

/// Sums over the pieces of a body: their number, places of their nodes (from a place in the body),
/// displacements, place cross displacement, and the square of the place.
enum Sum : std::size_t { count, places_x, places_y, moves_x, moves_y, turn, inertia, all_sums };

struct RigidMotion {
  Vec2 about{0, 0};
  Vec2 shift{0, 0};
  double angle = 0.0;

  Vec2 at(const Vec2& x) const { return shift + angle * turned_left(x - about); }
};

RigidMotion motion_of(const double* sums, const Vec2& from) {
  RigidMotion motion;
  if (sums[count] == 0.0) return motion;
  const Vec2 middle = Vec2(sums[places_x], sums[places_y]) / sums[count];
  motion.about = from + middle;
  motion.shift = Vec2(sums[moves_x], sums[moves_y]) / sums[count];
  const double about_middle = sums[inertia] - sums[count] * middle.squaredNorm();
  if (about_middle > 1e-12 * sums[inertia])
    motion.angle = (sums[turn] - sums[count] * cross(middle, motion.shift)) / about_middle;
  return motion;
}

}  // namespace

std::vector<double> without_rigid_motions(const BasisContext& context, const Bodies& bodies,
                                          std::span<const double> displacements,
                                          Communicator& communicator) {
  std::vector<double> rest(displacements.begin(), displacements.end());
  const auto& list = bodies.list();
  if (std::all_of(list.begin(), list.end(), [](const Body& b) { return b.held; })) return rest;
  const auto for_loose_pieces = [&](LocalId nodes, const auto& visit) {
    for (LocalId n = 0; n < nodes; ++n) {
      const Vec2 x = context.mesh.grid().node_position(context.mesh.node(n));
      for (int p = 0; p < context.unknowns.pieces(n); ++p) {
        const std::size_t body = bodies.body_of(n, p);
        if (!list[body].held) visit(body, x, std::size_t(context.unknowns.of_piece(n, p)));
      }
    }
  };
  std::vector<double> sums(all_sums * list.size(), 0.0);
  for_loose_pieces(context.mesh.owned_nodes(),
                   [&](std::size_t body, const Vec2& at, std::size_t k) {
                     const Vec2 x = at - list[body].at, u(rest[k], rest[k + 1]);
                     double* s = &sums[all_sums * body];
                     s[count] += 1.0;
                     s[places_x] += x.x();
                     s[places_y] += x.y();
                     s[moves_x] += u.x();
                     s[moves_y] += u.y();
                     s[turn] += cross(x, u);
                     s[inertia] += x.squaredNorm();
                   });
  communicator.sum(std::span<double>(sums));
  std::vector<RigidMotion> motions;
  for (std::size_t b = 0; b < list.size(); ++b)
    motions.push_back(motion_of(&sums[all_sums * b], list[b].at));
  for_loose_pieces(context.mesh.node_count(), [&](std::size_t body, const Vec2& at, std::size_t k) {
    const Vec2 u = motions[body].at(at);
    rest[k] -= u.x();
    rest[k + 1] -= u.y();
  });
  return rest;
}

}  // namespace cdca
