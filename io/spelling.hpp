// SPDX-License-Identifier: BSD-3-Clause
/// What a mistyped word may have been meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cdca {

/// The candidate nearest to `word`, or one that begins with it; empty when none is near enough to
/// be a slip of the fingers.
std::string nearest_spelling(std::string_view word, const std::vector<std::string>& candidates);

/// `; did you mean "young"?`, or `otherwise` when no candidate is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                         const std::string& otherwise);

}  // namespace cdca
