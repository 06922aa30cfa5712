// SPDX-License-Identifier: BSD-3-Clause
/// The input of a run as it was understood, to be written beside the results.
#pragma once

#include "io/config_node.hpp"

#include <string>

namespace cdca {

/// A case file with all values of `root`, defaults and settings of the command line included, and
/// the meaning of every key. Reading it again gives the same case.
std::string effective_input(const ConfigNode& root);

}  // namespace cdca
