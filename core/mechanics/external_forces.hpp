// SPDX-License-Identifier: BSD-3-Clause
/// Nodal forces of tractions, point forces, body forces and loads on crack faces.
#pragma once

#include "core/cells/part_basis.hpp"
#include "core/mechanics/boundary_spec.hpp"

#include <array>
#include <functional>
#include <vector>

namespace cdca {

/// A traction on the faces of one crack: on_plus(x, n) in Pa acts on the face on the left of the
/// crack's direction, its negative on the other; n points from the minus to the plus face.
struct FaceLoad {
  int crack = 0;
  std::function<Vec2(const Vec2& x, const Vec2& n)> on_plus;
};

class ContactPatches;

/// Everything that acts on the body at one load factor.
struct ExternalLoads {
  struct SideTraction {
    Side side = Side::left;
    std::function<Vec2(const Vec2& x)> value;  ///< Pa
  };
  struct PointForce {
    Vec2 at{0, 0};
    Vec2 value{0, 0};  ///< N per metre of thickness
  };
  std::vector<SideTraction> tractions;
  std::vector<PointForce> forces;
  std::function<Vec2(const Vec2& x)> body;  ///< N/m^3; empty: none
  std::vector<FaceLoad> faces;
  const ContactPatches* contact = nullptr;  ///< tractions of touching faces; forces come with K
  std::array<bool, 4> held_sides{};  ///< by Side: displacements are prescribed, tractions unknown
};

/// The loads of the blocks at load factor s. crack_names: by number.
ExternalLoads loads_at(const std::vector<BoundarySpec>& blocks, const LoadVector& body_force,
                       const std::vector<std::string>& crack_names, double s);

/// Adds int N_i^a t ds + int N_i^a b dA + ... (Eq. 14) to the forces on own cells, N per metre of
/// thickness. Entries of ghosts are left alone: their owners see the same loads.
void add_external_forces(const BasisContext& context, const ExternalLoads& loads,
                         std::span<double> forces);

}  // namespace cdca
