// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/types.hpp"

#include <cstddef>

namespace cdca {

/// What a unit of one unknown does to one of several measures, which are numbered.
struct Effect {
  std::size_t measure = 0;
  LocalId unknown = 0;
  double value = 0.0;
};

}  // namespace cdca
