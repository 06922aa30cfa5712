// SPDX-License-Identifier: BSD-3-Clause
/// The manual page of the case file, made from the table of options.
#pragma once

#include <string>

namespace cdca {

/// All keys with type, unit, default and meaning, as Markdown: docs/case-file.md.
std::string case_manual();

}  // namespace cdca
