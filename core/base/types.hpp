// SPDX-License-Identifier: BSD-3-Clause
/// Words that every layer uses: points, vectors, ids.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace cdca {

/// A point or a vector in the plane; metres unless a function says otherwise.
using Vec2 = Eigen::Vector2d;
/// A stress or a strain as (xx, yy, xy). Stress in Pa, tension positive; strain with the tensor's
/// xy.
using Voigt = Eigen::Vector3d;

/// Number of a node or an element in the whole grid; the same on every rank.
using GlobalId = std::int64_t;
/// Number of something that this rank holds.
using LocalId = std::int32_t;

/// The z component of a x b: positive when b lies counter-clockwise of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The vector turned by +90 degrees.
inline Vec2 turned_left(const Vec2& a) { return {-a.y(), a.x()}; }

}  // namespace cdca
