// SPDX-License-Identifier: BSD-3-Clause
/// The result in small, as JSON.
#pragma once

#include "core/simulation/snapshot.hpp"

#include <string>

namespace cdca {

/// The text of summary.json. Numbers read back as exactly the same; a number that is not finite,
/// the K and U of a tip that is not active, and a partner, crack or end that does not exist are
/// null.
std::string summary_json(const Summary& summary);

}  // namespace cdca
