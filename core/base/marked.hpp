// SPDX-License-Identifier: BSD-3-Clause
/// Few marks among many places.
#pragma once

#include "core/base/types.hpp"

#include <cstring>
#include <span>
#include <vector>

namespace cdca {

/// The places whose flag is 1, ascending; all others are 0. Where few are marked this costs far
/// less than a look at every flag.
inline std::vector<LocalId> marked(std::span<const char> flags) {
  std::vector<LocalId> places;
  const char *at = flags.data(), *end = at + flags.size();
  while (at != end) {
    at = static_cast<const char*>(std::memchr(at, 1, std::size_t(end - at)));
    if (!at) break;
    places.push_back(LocalId(at++ - flags.data()));
  }
  return places;
}

}  // namespace cdca
