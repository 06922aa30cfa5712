// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/random_cracks.hpp"
#include "io/case_contact.hpp"
#include "io/case_cracks.hpp"
#include "io/case_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cdca {
namespace {

using Problems = std::vector<Problem>;

/// False when the region leaves the body; says so.
bool is_in_body(const ConfigNode& region, const Rectangle& box, const DomainSpec& domain,
                Problems& problems) {
  const Vec2 low = domain.origin;
  const Vec2 high = domain.origin + domain.size;
  const double outside = std::max((low - box.lower).maxCoeff(), (box.upper - high).maxCoeff());
  if (outside <= 1e-9 * domain.size.maxCoeff()) return true;
  problems.push_back(problem_at(
      region, "crack_field.region",
      fmt::format("Found {}, which reaches out of the body; allowed is a box from [{:.6g}, {:.6g}] "
                  "to [{:.6g}, {:.6g}] or in it.",
                  toml_value(region), low.x(), low.y(), high.x(), high.y())));
  return false;
}

/// A name of a block must not be that of a random crack.
void check_name(const ConfigNode& root, std::size_t block, const std::string& name,
                Problems& problems) {
  const auto& crack = root.find("crack")->items[block];
  const auto* written = crack.find("name");
  problems.push_back(problem_at(
      written ? *written : crack, fmt::format("crack[{}].name", block),
      fmt::format("The name \"{}\" is that of a crack of crack_field too; every crack needs a name "
                  "of its own.",
                  name)));
}

}  // namespace

void add_random_cracks(const ConfigNode& root, CaseSpec& spec, std::vector<Problem>& problems) {
  const TableReader table(root, "crack_field");
  const auto* count = table.find("count");
  const auto* length = table.find("length");
  const auto* angle = table.find("angle");
  const auto* seed = table.find("seed");
  const bool is_wrong = std::any_of(problems.begin(), problems.end(), [](const Problem& problem) {
    return problem.key.starts_with("crack_field.");
  });
  if (!count || !length || !angle || !seed || is_wrong) return;
  if (spec.domain.size.minCoeff() <= 0.0) return;

  CrackFieldSpec field;
  field.count = static_cast<int>(count->integer);
  for (std::size_t i = 0; i < 2; ++i) {
    field.length[i] = length->items[i].number;
    field.angle[i] = angle->items[i].number;
  }
  field.seed = static_cast<std::uint64_t>(seed->integer);
  field.region = {spec.domain.origin, spec.domain.origin + spec.domain.size};
  if (const auto* region = table.find("region")) {
    const auto& at = region->items;
    field.region = {{at[0].number, at[1].number}, {at[2].number, at[3].number}};
    if (!is_in_body(*region, field.region, spec.domain, problems)) return;
  }
  const double longest = (field.region.upper - field.region.lower).norm();
  std::vector<std::array<Vec2, 2>> cracks;
  try {
    if (field.length[0] < longest) cracks = random_cracks(field);
  } catch (const InputError&) {
    // reported below: too few
  }
  if (cracks.empty()) {
    problems.push_back(problem_at(
        *length, "crack_field.length",
        fmt::format("Found {}, but cracks of this length hardly fit into the region; allowed are "
                    "shorter ones, or a larger crack_field.region.",
                    toml_value(*length))));
    return;
  }
  const auto blocks = spec.cracks.size();
  for (std::size_t i = 0; i < cracks.size(); ++i) {
    const auto name = fmt::format("random{}", i + 1);
    for (std::size_t k = 0; k < blocks; ++k) {
      if (spec.cracks[k].name == name) check_name(root, k, name, problems);
    }
    spec.cracks.push_back({name, {cracks[i][0], cracks[i][1]}, table.line(), common_contact(root)});
  }
}

}  // namespace cdca
