// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_growth.hpp"

#include "io/case_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace cdca {
namespace {

using Problems = std::vector<Problem>;

bool was_reported(std::string_view key, const Problems& problems) {
  return std::any_of(problems.begin(), problems.end(),
                     [&](const Problem& problem) { return problem.key == key; });
}

void check_strength(const ConfigNode& criterion, const std::optional<double>& value,
                    std::string_view needed, Problems& problems) {
  const auto key = fmt::format("material.{}", needed);
  if (value || was_reported(key, problems)) return;
  problems.push_back(
      problem_at(criterion, "growth.criterion",
                 fmt::format("The criterion \"{}\" needs {}, which is not given; allowed are a "
                             "value for it, or another criterion.",
                             criterion.text, key)));
}

void read_step_length(const TableReader& table, const DomainSpec& domain, GrowthSpec& growth,
                      Problems& problems) {
  const auto* length = table.find("step_length");
  if (!length) return;
  if (length->is_number()) {
    growth.step_length = {length->number, length->number};
  } else {
    table.read("step_length", growth.step_length);
  }
  const auto [low, high] = growth.step_length;
  if (growth.fixed_step && low != high) {
    problems.push_back(
        problem_at(*length, "growth.step_length",
                   fmt::format("The step \"fixed\" has one length, but step_length is {}; allowed "
                               "is one number.",
                               toml_value(*length))));
  }
  const double extent = domain.size.maxCoeff();
  const Vec2 side(domain.size.x() / domain.cells[0], domain.size.y() / domain.cells[1]);
  const double shortest = 0.01 * (growth.step_in_metres ? side.minCoeff() : 1.0);
  if (extent > 0.0 && domain.cells[0] > 0 && domain.cells[1] > 0 && low > 0.0 && low < shortest) {
    problems.push_back(
        problem_at(*length, "growth.step_length",
                   fmt::format("Found {}, a growth step of less than a hundredth of an element, "
                               "which the grid does not resolve; allowed are steps of at least "
                               "{}{}.",
                               toml_value(*length), toml_number(shortest),
                               growth.step_in_metres ? " m" : " elements")));
  }
  if (growth.step_in_metres && extent > 0.0 && low > extent) {
    problems.push_back(problem_at(
        *length, "growth.step_length",
        fmt::format("With step_unit \"m\", {} is longer than the body; allowed are steps of at "
                    "most {} m.",
                    toml_value(*length), toml_number(extent))));
  }
}

}  // namespace

LoadingSpec build_loading(const ConfigNode& root, std::vector<Problem>& problems) {
  const TableReader table(root, "loading");
  LoadingSpec loading;
  loading.critical = table.says("mode", "critical");
  table.read("max_events", loading.max_events);
  table.read("min_factor", loading.min_factor);
  if (!loading.critical) return loading;
  for (const auto* key : {"steps", "factors"}) {
    const auto* node = table.find(key);
    if (!node) continue;
    problems.push_back(problem_at(
        *node, fmt::format("loading.{}", key),
        fmt::format("The key \"{}\" contradicts the mode \"critical\", which finds the load "
                    "factors itself; allowed is one of them.",
                    key)));
  }
  if (TableReader(root, "growth").says("criterion", "none")) {
    problems.push_back(
        problem_at(*table.find("mode"), "loading.mode",
                   "The mode \"critical\" needs cracks that grow, but growth.criterion is "
                   "\"none\"; allowed are the criteria \"hoop\" and \"mixed\"."));
  }
  return loading;
}

GrowthSpec build_growth(const ConfigNode& root, const CaseSpec& spec,
                        std::vector<Problem>& problems) {
  const TableReader table(root, "growth");
  GrowthSpec growth;
  growth.line = table.line();
  if (table.says("criterion", "hoop")) {
    growth.criterion = Criterion::hoop;
    check_strength(*table.find("criterion"), spec.material.toughness, "toughness", problems);
  } else if (table.says("criterion", "mixed")) {
    growth.criterion = Criterion::mixed;
    check_strength(*table.find("criterion"), spec.material.tensile_strength, "tensile_strength",
                   problems);
  }
  if (!table.says("radius", "auto")) table.read("radius", growth.radius);
  growth.full_field = table.says("field", "full");
  table.read("literal", growth.literal);
  growth.fixed_step = table.says("step", "fixed");
  growth.step_in_metres = table.says("step_unit", "m");
  read_step_length(table, spec.domain, growth, problems);
  growth.corrected = !table.says("direction", "explicit");
  table.read("cycles", growth.cycles);
  return growth;
}

}  // namespace cdca
