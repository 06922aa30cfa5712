// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_boundaries.hpp"

#include "io/case_loads.hpp"
#include "io/case_options.hpp"
#include "io/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace cdca {
namespace {

using Problems = std::vector<Problem>;

constexpr std::string_view crack_prefix = "crack:";

struct PlaceRule {
  BoundaryKind kind;
  std::string_view name;  ///< in a sentence
  std::string_view keys;  ///< that go with it
};

constexpr PlaceRule place_rules[] = {
    {BoundaryKind::side, "on a side", "displacement|traction"},
    {BoundaryKind::point, "at a point", "displacement|force"},
    {BoundaryKind::crack, "on the faces of a crack", "pressure"},
};

std::optional<Side> side_of(std::string_view word) {
  if (word == "left") return Side::left;
  if (word == "right") return Side::right;
  if (word == "bottom") return Side::bottom;
  if (word == "top") return Side::top;
  return std::nullopt;
}

bool acts(const BoundarySpec& boundary) {
  const auto any = [](const LoadVector& values) { return values[0] || values[1]; };
  return any(boundary.displacement) || any(boundary.traction) || any(boundary.force) ||
         boundary.pressure;
}

/// Reads one block.
class BoundaryReader {
 public:
  BoundaryReader(const ConfigNode& block, std::size_t index, const CaseSpec& spec,
                 Problems& problems)
      : block_(block),
        path_(fmt::format("boundary[{}]", index)),
        spec_(spec),
        problems_(problems) {}

  BoundarySpec read() {
    BoundarySpec boundary;
    boundary.line = block_.line;
    // What validation took out may be what seems to be missing.
    const bool complete =
        std::none_of(problems_.begin(), problems_.end(),
                     [&](const Problem& problem) { return problem.key.starts_with(path_ + "."); });
    if (!find_place(boundary, complete)) return boundary;
    const auto before = problems_.size();
    check_keys(boundary);
    read_values(boundary);
    if (complete && problems_.size() == before) check_purpose(boundary);
    return boundary;
  }

 private:
  void add(const ConfigNode& node, std::string_view key, const std::string& message) {
    problems_.push_back(
        problem_at(node, key.empty() ? path_ : fmt::format("{}.{}", path_, key), message));
  }

  bool find_place(BoundarySpec& boundary, bool complete) {
    if (const auto* on = block_.find("on")) return find_line(*on, boundary);
    if (const auto* at = block_.find("at")) return find_point(*at, boundary);
    if (complete) {
      add(block_, "",
          "The place is missing; allowed is on = \"left\", \"right\", \"bottom\", \"top\" or "
          "\"crack:NAME\", or at = [x, y].");
    }
    return false;
  }

  bool find_line(const ConfigNode& on, BoundarySpec& boundary) {
    boundary.name = on.text;
    if (const auto side = side_of(on.text)) {
      boundary.kind = BoundaryKind::side;
      boundary.side = *side;
      return true;
    }
    if (on.text.starts_with(crack_prefix)) return find_crack(on, boundary);
    add(on, "on",
        fmt::format(
            "Found {}; allowed are \"left\", \"right\", \"bottom\", \"top\" and \"crack:NAME\"{}",
            describe(on), did_you_mean(on.text, {"left", "right", "bottom", "top"}, ".")));
    return false;
  }

  bool find_crack(const ConfigNode& on, BoundarySpec& boundary) {
    boundary.kind = BoundaryKind::crack;
    boundary.crack = on.text.substr(crack_prefix.size());
    std::vector<std::string> names;
    for (const auto& crack : spec_.cracks) names.push_back(crack.name);
    if (std::find(names.begin(), names.end(), boundary.crack) != names.end()) return true;
    const auto all = names.empty()
                         ? "; the case has no cracks."
                         : fmt::format("; the cracks are {}.", quoted_words(names, "and"));
    add(on, "on",
        fmt::format("There is no crack \"{}\"{}", boundary.crack,
                    did_you_mean(boundary.crack, names, names.size() > 10 ? "." : all)));
    return false;
  }

  bool find_point(const ConfigNode& at, BoundarySpec& boundary) {
    boundary.kind = BoundaryKind::point;
    boundary.at = {at.items[0].number, at.items[1].number};
    const Vec2 low = spec_.domain.origin;
    const Vec2 high = low + spec_.domain.size;
    const double tolerance = 1e-9 * spec_.domain.size.maxCoeff();
    const double outside =
        std::max((low - boundary.at).maxCoeff(), (boundary.at - high).maxCoeff());
    if (outside <= tolerance || spec_.domain.size.minCoeff() <= 0.0) return true;
    add(at, "at",
        fmt::format(
            "Found the point [{}, {}], which is outside of the body; allowed are points from "
            "[{}, {}] to [{}, {}].",
            boundary.at.x(), boundary.at.y(), low.x(), low.y(), high.x(), high.y()));
    return false;
  }

  void check_keys(const BoundarySpec& boundary) {
    const auto& rule = place_rules[static_cast<std::size_t>(boundary.kind)];
    const auto allowed = words_of(rule.keys);
    for (const auto& key : block_.keys) {
      if (key == "on" || key == "at") continue;
      if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
      add(*block_.find(key), key,
          fmt::format("The key \"{}\" does not go with a block {}; allowed there {} {}.", key,
                      rule.name, allowed.size() == 1 ? "is" : "are", quoted_words(allowed, "and")));
    }
  }

  std::vector<Vec2> places(const BoundarySpec& boundary) const {
    if (boundary.kind == BoundaryKind::point) return {boundary.at};
    if (boundary.kind == BoundaryKind::side) return places_on(spec_.domain, boundary.side);
    const auto crack =
        std::find_if(spec_.cracks.begin(), spec_.cracks.end(),
                     [&](const CrackSpec& one) { return one.name == boundary.crack; });
    return places_on(*crack);
  }

  void read_values(BoundarySpec& boundary) {
    const LoadReader loads(spec_, places(boundary), problems_);
    if (const auto* value = block_.find("displacement")) {
      boundary.displacement = loads.support_pair(*value, path_ + ".displacement");
    }
    if (const auto* value = block_.find("traction")) {
      boundary.traction = loads.load_pair(*value, path_ + ".traction");
    }
    if (const auto* value = block_.find("force")) {
      boundary.force = loads.load_pair(*value, path_ + ".force");
    }
    if (const auto* value = block_.find("pressure")) {
      boundary.pressure = loads.load(*value, path_ + ".pressure");
    }
  }

  /// A load of zero is a load that somebody studies; nothing at all is a mistake.
  void check_purpose(const BoundarySpec& boundary) {
    const bool has_load =
        block_.find("traction") || block_.find("force") || block_.find("pressure");
    if (has_load || acts(boundary)) return;
    const auto& rule = place_rules[static_cast<std::size_t>(boundary.kind)];
    const bool all_free = block_.find("displacement") != nullptr;
    add(block_, "",
        fmt::format("The block does nothing{}; it needs {}.",
                    all_free ? ", as both components of its displacement are \"free\"" : "",
                    quoted_words(words_of(rule.keys), "or")));
  }

  const ConfigNode& block_;
  std::string path_;
  const CaseSpec& spec_;
  Problems& problems_;
};

/// Columns of results are named after the blocks: the second block on a side becomes "left_2".
void make_names_unique(std::vector<BoundarySpec>& boundaries) {
  int points = 0;
  std::vector<std::string> used;
  for (auto& boundary : boundaries) {
    if (boundary.kind == BoundaryKind::point) boundary.name = fmt::format("at_{}", ++points);
    const auto base = boundary.name;
    for (int n = 2; std::find(used.begin(), used.end(), boundary.name) != used.end(); ++n) {
      boundary.name = fmt::format("{}_{}", base, n);
    }
    used.push_back(boundary.name);
  }
}

}  // namespace

void build_boundaries(const ConfigNode& root, CaseSpec& spec, std::vector<Problem>& problems) {
  const auto* list = root.find("boundary");
  if (!list) return;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    spec.boundaries.push_back(BoundaryReader(list->items[i], i, spec, problems).read());
  }
  make_names_unique(spec.boundaries);
}

}  // namespace cdca
