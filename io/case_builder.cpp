// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_builder.hpp"

#include "io/case_boundaries.hpp"
#include "io/case_contact.hpp"
#include "io/case_cracks.hpp"
#include "io/case_growth.hpp"
#include "io/case_loads.hpp"
#include "io/case_supports.hpp"
#include "io/case_table.hpp"

#include <fmt/format.h>

namespace cdca {
namespace {

using Problems = std::vector<Problem>;

DomainSpec build_domain(const ConfigNode& root) {
  const TableReader table(root, "domain");
  DomainSpec domain;
  table.read("size", domain.size);
  table.read("origin", domain.origin);
  if (const auto* cells = table.find("cells")) {
    domain.cells = {static_cast<int>(cells->items[0].integer),
                    static_cast<int>(cells->items[1].integer)};
  }
  table.read("thickness", domain.thickness);
  domain.plane_strain = table.says("plane", "strain");
  domain.line = table.line();
  return domain;
}

MaterialSpec build_material(const ConfigNode& root) {
  const TableReader table(root, "material");
  MaterialSpec material;
  table.read("young", material.young);
  table.read("poisson", material.poisson);
  table.read("tensile_strength", material.tensile_strength);
  table.read("cohesion", material.cohesion);
  table.read("friction_angle", material.friction_angle);
  table.read("toughness", material.toughness);
  material.line = table.line();
  return material;
}

std::vector<double> equal_factors(int steps) {
  std::vector<double> factors;
  for (int i = 1; i <= steps; ++i) factors.push_back(static_cast<double>(i) / steps);
  return factors;
}

std::vector<double> given_factors(const ConfigNode& list, Problems& problems) {
  std::vector<double> factors;
  for (const auto& item : list.items) {
    if (!factors.empty() && item.number <= factors.back()) {
      problems.push_back(problem_at(
          item, fmt::format("loading.factors[{}]", factors.size()),
          fmt::format(
              "Found {} after {}; allowed is a greater number, since load factors increase.",
              describe(item), toml_number(factors.back()))));
    }
    factors.push_back(item.number);
  }
  return factors;
}

/// In critical mode the load factor is found, and no steps are there.
std::vector<double> build_load_factors(const ConfigNode& root, Problems& problems) {
  const TableReader table(root, "loading");
  if (const auto* factors = table.find("factors")) return given_factors(*factors, problems);
  int steps = 1;
  table.read("steps", steps);
  return equal_factors(steps);
}

SolverSpec build_solver(const ConfigNode& root, Problems& problems) {
  const TableReader table(root, "solver");
  SolverSpec solver;
  if (table.says("method", "relaxation")) solver.method = SolverMethod::relaxation;
  if (table.says("method", "krylov")) solver.method = SolverMethod::krylov;
  table.read("tolerance", solver.tolerance);
  table.read("over_relaxation", solver.over_relaxation);
  table.read("max_iterations", solver.max_iterations);
  table.read("condensed_nodes", solver.condensed_nodes);
  const bool is_lost = solver.method != SolverMethod::relaxation && solver.over_relaxation != 1.0;
  if (is_lost) {
    const auto& node = *table.find("over_relaxation");
    problems.push_back(problem_at(node, "solver.over_relaxation",
                                  fmt::format("Found {}, but only the method \"relaxation\" has an "
                                              "over-relaxation; allowed is 1.0, or "
                                              "that method.",
                                              describe(node))));
  }
  return solver;
}

OutputSpec build_output(const ConfigNode& root) {
  const TableReader table(root, "output");
  OutputSpec output;
  table.read("every", output.every);
  table.read("checkpoint_every", output.checkpoint_every);
  table.read("pictures", output.pictures);
  return output;
}

}  // namespace

CaseSpec build_case(const ConfigNode& root, std::vector<Problem>& problems) {
  CaseSpec spec;
  if (const auto* title = root.find("title")) spec.title = title->text;
  spec.domain = build_domain(root);
  spec.material = build_material(root);
  TableReader(root, "enrichment").read("tip_radius", spec.tip_radius);
  spec.load_factors = build_load_factors(root, problems);
  spec.loading = build_loading(root, problems);
  spec.growth = build_growth(root, spec, problems);
  spec.solver = build_solver(root, problems);
  spec.output = build_output(root);
  check_contact(root, problems);
  spec.cracks = build_cracks(root, spec.domain, problems);
  add_random_cracks(root, spec, problems);
  if (const auto* force = TableReader(root, "domain").find("body_force")) {
    const LoadReader loads(spec, places_in(spec.domain), problems);
    spec.domain.body_force = loads.load_pair(*force, "domain.body_force");
  }
  const auto before = problems.size();
  build_boundaries(root, spec, problems);
  if (problems.size() == before) check_supports(root, spec, problems);
  return spec;
}

}  // namespace cdca
