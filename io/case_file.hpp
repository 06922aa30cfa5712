// SPDX-License-Identifier: BSD-3-Clause
/// Case files: TOML in, a checked CaseSpec out.
#pragma once

#include "core/base/communicator.hpp"
#include "core/simulation/case_spec.hpp"

#include <string>
#include <vector>

namespace cdca {

/// Reads and checks a case file. `overrides` are settings "key.path=value" of the command line,
/// which win over the file. \throws InputError with everything that is wrong, sorted by line; also
/// when the file cannot be read.
CaseSpec read_case(const std::string& path, const std::vector<std::string>& overrides = {});

/// As above on all ranks: one rank reads the file, and all ranks take, or refuse, the same text.
CaseSpec read_case(const std::string& path, const std::vector<std::string>& overrides,
                   Communicator& ranks);

/// As above with the text of the file at hand; `file` is its name.
CaseSpec read_case_text(const std::string& text, const std::string& file,
                        const std::vector<std::string>& overrides = {});

}  // namespace cdca
