// SPDX-License-Identifier: BSD-3-Clause
/// One value of a case file against the option that declares it.
#pragma once

#include "io/case_options.hpp"
#include "io/config_node.hpp"

#include <string>
#include <vector>

namespace cdca {

/// Adds what is wrong with the value of an option to `problems`: its shape, type, range or word, or
/// that this version does not support it. `path` names it, as in "crack[1].points".
void check_value(const Option& option, const ConfigNode& value, const std::string& path,
                 std::vector<Problem>& problems);

/// A key, a table or a value ("kind") is part of the case file, but of a later version.
std::string later_sentence(const std::string& kind);

}  // namespace cdca
