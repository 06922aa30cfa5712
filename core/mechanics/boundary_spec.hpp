// SPDX-License-Identifier: BSD-3-Clause
/// Supports and loads as the user states them.
#pragma once

#include "core/base/types.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace cdca {

/// A load as a function of the place (x, y in m) and the load factor s.
struct LoadValue {
  std::function<double(double x, double y, double s)> at;
  bool proportional = true;  ///< at(x, y, s) = s at(x, y, 1)
  std::string text;          ///< as written in the case file
};

/// A plain number of the case file: reached at load factor 1.
LoadValue proportional_load(double value);

using LoadVector = std::array<std::optional<LoadValue>, 2>;  ///< no value: "free" or zero

enum class Side { left, right, bottom, top };
enum class BoundaryKind { side, point, crack };

/// One [[boundary]] block: supports and loads on a side, at a point or on the faces of a crack.
struct BoundarySpec {
  BoundaryKind kind = BoundaryKind::side;
  std::string name;  ///< "left", ..., "crack:NAME", or "at_1", "at_2", ... for points
  Side side = Side::left;
  Vec2 at{0, 0};            ///< m; supports take the nearest node, forces act at the point itself
  std::string crack;        ///< name of the crack whose faces are loaded
  LoadVector displacement;  ///< m; free where there is no value
  LoadVector traction;      ///< Pa, global components, on a side
  LoadVector force;         ///< N per m of thickness, at a point
  std::optional<LoadValue> pressure;  ///< Pa, opens the crack when positive
  int line = 0;
};

}  // namespace cdca
