// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_describe.hpp"

#include "io/case_contact.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cdca {
namespace {

/// A case may have thousands of cracks.
constexpr std::size_t most_listed = 20;

std::string point_text(const Vec2& at) { return fmt::format("[{:.6g}, {:.6g}]", at.x(), at.y()); }

std::string line(std::string_view name, const std::string& value) {
  return fmt::format("{:<12}{}\n", name, value);
}

std::string domain_text(const DomainSpec& domain) {
  const Vec2 h(domain.size.x() / domain.cells[0], domain.size.y() / domain.cells[1]);
  return line("body", fmt::format("{:.6g} x {:.6g} m from {}, {:.6g} m thick, plane {}",
                                  domain.size.x(), domain.size.y(), point_text(domain.origin),
                                  domain.thickness, domain.plane_strain ? "strain" : "stress")) +
         line("cells", fmt::format("{} x {} elements of {:.6g} x {:.6g} m", domain.cells[0],
                                   domain.cells[1], h.x(), h.y()));
}

std::string material_text(const MaterialSpec& material) {
  std::string text = fmt::format("E = {:.6g} Pa, nu = {:.6g}", material.young, material.poisson);
  if (material.tensile_strength)
    text += fmt::format(", tensile strength {:.6g} Pa", *material.tensile_strength);
  if (material.cohesion) text += fmt::format(", cohesion {:.6g} Pa", *material.cohesion);
  if (material.friction_angle)
    text += fmt::format(", friction angle {:.6g} degrees", *material.friction_angle);
  if (material.toughness) text += fmt::format(", toughness {:.6g} Pa m^1/2", *material.toughness);
  return line("material", text);
}

std::string cracks_text(const CaseSpec& spec, int tips) {
  double total = 0.0;
  for (const auto& crack : spec.cracks) total += length_of(crack);
  std::string out = line("cracks", fmt::format("{}, {:.6g} m in all; active tips: {}",
                                               spec.cracks.size(), total, tips));
  for (std::size_t i = 0; i < spec.cracks.size() && i < most_listed; ++i) {
    const auto& crack = spec.cracks[i];
    out += line("", fmt::format("{}: {} points from {} to {}, {:.6g} m", crack.name,
                                crack.points.size(), point_text(crack.points.front()),
                                point_text(crack.points.back()), length_of(crack)));
  }
  if (spec.cracks.size() > most_listed)
    out += line("", fmt::format("and {} more", spec.cracks.size() - most_listed));
  return out;
}

/// A line per law, with its cracks where there are several laws.
std::string contact_text(const CaseSpec& spec) {
  std::vector<std::pair<std::string, std::vector<std::string>>> laws;
  for (const auto& crack : spec.cracks) {
    const auto text = describe_contact(crack.contact);
    const auto place =
        std::find_if(laws.begin(), laws.end(), [&](const auto& law) { return law.first == text; });
    auto& law = place == laws.end() ? laws.emplace_back(text, std::vector<std::string>()) : *place;
    law.second.push_back(crack.name);
  }
  std::string out;
  for (auto& [text, names] : laws) {
    const auto count = names.size();
    if (count > most_listed) names.resize(most_listed);
    const auto more = count > most_listed ? fmt::format(" and {} more", count - most_listed) : "";
    const auto whose = laws.size() > 1 ? fmt::format(": {}{}", fmt::join(names, ", "), more) : "";
    out += line(out.empty() ? "contact" : "", text + whose);
  }
  return out;
}

std::string vector_text(std::string_view name, const LoadVector& values, std::string_view absent,
                        std::string_view unit) {
  if (!values[0] && !values[1]) return {};
  const auto component = [&](int axis) {
    return values[axis] ? values[axis]->text : std::string(absent);
  };
  return fmt::format(", {} [{}, {}] {}", name, component(0), component(1), unit);
}

std::string boundary_text(const BoundarySpec& boundary) {
  std::string text = boundary.name;
  if (boundary.kind == BoundaryKind::point) text += " " + point_text(boundary.at);
  text += vector_text("displacement", boundary.displacement, "free", "m");
  text += vector_text("traction", boundary.traction, "0", "Pa");
  text += vector_text("force", boundary.force, "0", "N/m");
  if (boundary.pressure) text += fmt::format(", pressure {} Pa", boundary.pressure->text);
  return text;
}

std::string loads_text(const CaseSpec& spec) {
  const auto& factors = spec.load_factors;
  const auto steps = factors.size() == 1
                         ? fmt::format("1 step, load factor {:.6g}", factors.front())
                         : fmt::format("{} steps, load factor {:.6g} to {:.6g}", factors.size(),
                                       factors.front(), factors.back());
  const auto critical =
      fmt::format("critical: at most {} growth events, ends below {:.6g} of the largest factor",
                  spec.loading.max_events, spec.loading.min_factor);
  std::string out = line("loads", spec.loading.critical ? critical : steps);
  for (const auto& boundary : spec.boundaries) out += line("", boundary_text(boundary));
  const auto body_force = vector_text("body force", spec.domain.body_force, "0", "N/m^3");
  if (!body_force.empty()) out += line("", body_force.substr(2));
  return out;
}

std::string growth_text(const GrowthSpec& growth) {
  if (growth.criterion == Criterion::none) return line("growth", "none");
  const auto [low, high] = growth.step_length;
  const auto length =
      low == high ? fmt::format("{:.6g}", low) : fmt::format("{:.6g} to {:.6g}", low, high);
  return line("growth", fmt::format("{}, {} steps of {} {}, {} directions",
                                    growth.criterion == Criterion::hoop ? "hoop" : "mixed",
                                    growth.fixed_step ? "fixed" : "arrest", length,
                                    growth.step_in_metres ? "m" : "element sides",
                                    growth.corrected ? "corrected" : "explicit"));
}

}  // namespace

std::string bytes_text(std::int64_t bytes) {
  constexpr std::string_view units[] = {"B", "kB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1000.0 && unit + 1 < std::size(units); ++unit) value /= 1000.0;
  return fmt::format("{:.3g} {}", value, units[unit]);
}

std::string describe_case(const CaseSpec& spec, const CaseSize& size) {
  constexpr std::string_view methods[] = {"relaxation", "krylov", "multilevel"};
  return line("title", spec.title) + domain_text(spec.domain) + material_text(spec.material) +
         cracks_text(spec, size.tips) + contact_text(spec) +
         line("tip radius", spec.tip_radius > 0.0 ? fmt::format("{:.6g} m", spec.tip_radius)
                                                  : "the nodes of the tip element") +
         loads_text(spec) + growth_text(spec.growth) +
         line("solver",
              fmt::format("{}, tolerance {:.3g}", methods[std::size_t(spec.solver.method)],
                          spec.solver.tolerance)) +
         line("size", fmt::format("{} elements, {} nodes, {} unknowns", size.elements, size.nodes,
                                  size.unknowns)) +
         line("memory", fmt::format("about {}", bytes_text(size.bytes)));
}

}  // namespace cdca
