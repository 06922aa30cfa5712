// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_cracks.hpp"

#include "io/case_contact.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

namespace cdca {
namespace {

using Problems = std::vector<Problem>;

Vec2 point_of(const ConfigNode& pair) { return {pair.items[0].number, pair.items[1].number}; }

/// Names stand in tables of results, and after "crack:".
bool is_allowed_name(const std::string& name) {
  for (const char c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == ',' || c == '"') return false;
  }
  return name.front() != ' ' && name.back() != ' ';
}

std::string name_of(const ConfigNode& block, std::size_t i, Problems& problems) {
  const auto* name = block.find("name");
  if (!name) return fmt::format("crack{}", i + 1);
  if (!is_allowed_name(name->text)) {
    problems.push_back(problem_at(
        *name, fmt::format("crack[{}].name", i),
        fmt::format("Found {}; allowed is a name without commas, quotes, control characters and "
                    "spaces at its ends.",
                    describe(*name))));
  }
  return name->text;
}

std::vector<Vec2> straight(const ConfigNode& center, double length, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const Vec2 half = 0.5 * length * Vec2(std::cos(angle), std::sin(angle));
  return {point_of(center) - half, point_of(center) + half};
}

/// `wrong`: problems of this block were reported before, so what is missing may have been there.
std::vector<Vec2> points_of(const ConfigNode& block, std::size_t i, bool wrong,
                            Problems& problems) {
  std::vector<Vec2> points;
  if (const auto* list = block.find("points")) {
    for (const auto& item : list->items) points.push_back(point_of(item));
    return points;
  }
  const auto* center = block.find("center");
  const auto* length = block.find("length");
  const auto* angle = block.find("angle");
  if (center && length && angle) return straight(*center, length->number, angle->number);
  if (!wrong) {
    problems.push_back(problem_at(block, fmt::format("crack[{}]", i),
                                  "The place of the crack is missing or not complete; allowed are "
                                  "points, or all of center, length and angle."));
  }
  return points;
}

bool has_problems(const std::string& path, const Problems& problems) {
  for (const auto& problem : problems) {
    if (problem.key.starts_with(path)) return true;
  }
  return false;
}

void check_names(const std::vector<CrackSpec>& cracks, const std::vector<ConfigNode>& blocks,
                 Problems& problems) {
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < cracks.size(); ++i) {
    const auto [place, is_new] = first.emplace(cracks[i].name, i);
    if (is_new) continue;
    const auto* written = blocks[i].find("name");
    const auto origin = written ? "" : ", which this crack without a name gets by its place,";
    problems.push_back(problem_at(
        written ? *written : blocks[i], fmt::format("crack[{}].name", i),
        fmt::format(
            "The name \"{}\"{} is that of crack[{}] too; every crack needs a name of its own.",
            cracks[i].name, origin, place->second)));
  }
}

}  // namespace

std::vector<CrackSpec> build_cracks(const ConfigNode& root, const DomainSpec& domain,
                                    std::vector<Problem>& problems) {
  std::vector<CrackSpec> cracks;
  const auto* list = root.find("crack");
  if (!list) return cracks;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const auto& block = list->items[i];
    const bool wrong = has_problems(fmt::format("crack[{}].", i), problems);
    CrackSpec crack;
    crack.name = name_of(block, i, problems);
    crack.points = points_of(block, i, wrong, problems);
    crack.line = block.line;
    crack.contact = contact_of(root, block);
    cracks.push_back(std::move(crack));
  }
  check_names(cracks, list->items, problems);
  check_crack_geometry(cracks, domain, list->items, problems);
  return cracks;
}

}  // namespace cdca
