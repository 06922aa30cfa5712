// SPDX-License-Identifier: BSD-3-Clause
/// One rank's part of a step as a .vtu file. Only the .cpp beside this file knows VTK.
#pragma once

#include "core/simulation/snapshot.hpp"

#include <filesystem>

namespace cdca {

/// Writes polygons with their fields, as listed by field_arrays(). A part without polygons makes a
/// valid file without cells. Throws IoError, also when the lists of the part do not fit each other.
void write_vtu(const std::filesystem::path& file, const FieldPart& part);

/// Writes crack lines with their values, as listed by crack_arrays(). As above.
void write_vtu(const std::filesystem::path& file, const CrackPart& part);

}  // namespace cdca
