// SPDX-License-Identifier: BSD-3-Clause
/// The dichotomy search (4.2.4): joined cracks end on their partners as the grid has both.
#pragma once

#include "core/cracks/crack_paths.hpp"
#include "core/cracks/crack_registry.hpp"

#include <optional>

namespace cdca {

/// How the end of a joined crack lies to its partner once both are laid over the grid.
enum class Reach { short_of, on, past };

/// on: the path of the partner has a point at just the place where the crack ends. past: the crack
/// has met the partner shortly before. For an end that has joined a crack, which may be its own.
Reach reach_of(const CrackPaths& paths, const std::vector<Crack>& cracks, int crack, int end);

/// A place (m) for the end of a joined crack at which it lies on its partner. Steps 1-5 of the
/// paper: a point A on the crack that does not reach the partner, a point B on its prolongation
/// that passes it, and the middle C of both in place of one of them, until C lies on it; each is
/// judged by the paths on the grid. Where no A or B is found close by, the nearest point of the
/// partner's path.
Vec2 search_junction(const StructuredGrid& grid, const std::vector<Crack>& cracks, int crack,
                     int end);

/// Lays the cracks over the grid; joined ends that do not lie on their partners there are moved, by
/// far less than an element. Throws SolveError if that cannot be done.
CrackPaths lay_paths(const StructuredGrid& grid, CrackRegistry& registry);

}  // namespace cdca
