// SPDX-License-Identifier: BSD-3-Clause
/// A small case file and what is wrong with versions of it, for the tests of the case file.
#pragma once

#include "core/base/errors.hpp"
#include "io/case_file.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace cdca::testing {

/// Two cracks, all kinds of supports, a traction; right in every respect.
inline const std::string plate = R"(title = "Plate"
[domain]
size = [2.0, 4.0]
cells = [20, 40]
[material]
young = 1e9
poisson = 0.3
[[crack]]
name = "edge"
points = [[0.0, 2.0], [0.95, 2.0]]
[[crack]]
center = [1.5, 3.0]
length = 0.4
angle = 30.0
[[boundary]]
on = "bottom"
displacement = ["free", 0.0]
[[boundary]]
at = [0.0, 0.0]
displacement = [0.0, "free"]
[[boundary]]
on = "top"
traction = [0.0, 1e6]
[loading]
steps = 4
[solver]
tolerance = 1e-9
[output]
every = 2
)";

/// The text with one place changed; `from` must be there.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  if (place == std::string::npos) throw std::invalid_argument("not in the sample: " + from);
  return text.replace(place, from.size(), to);
}

/// 1-based line of the first occurrence.
inline int line_of(const std::string& text, const std::string& part) {
  const auto place = text.find(part);
  if (place == std::string::npos) throw std::invalid_argument("not in the text: " + part);
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(place);
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

/// What is wrong; empty when the case is accepted.
inline std::vector<Problem> problems_of(const std::string& text,
                                        const std::vector<std::string>& overrides = {}) {
  try {
    read_case_text(text, "plate.toml", overrides);
    return {};
  } catch (const InputError& error) {
    return error.problems();
  }
}

inline std::string text_of(const std::vector<Problem>& problems) {
  std::string text;
  for (const auto& problem : problems) {
    text += std::to_string(problem.line) + ": " + problem.key + ": " + problem.message + "\n";
  }
  return text;
}

}  // namespace cdca::testing
