// SPDX-License-Identifier: BSD-3-Clause
/// From TOML text to plain values.
#pragma once

#include "io/config_node.hpp"

#include <optional>
#include <string_view>

namespace cdca {

/// The table that a TOML text describes.
/// \throws InputError with the line, when the text is not TOML.
ConfigNode parse_toml(std::string_view text);

/// A single TOML value, as what stands right of an equals sign; none when it is not TOML.
std::optional<ConfigNode> parse_toml_value(std::string_view text);

}  // namespace cdca
