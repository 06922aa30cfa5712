// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_supports.hpp"

#include "io/case_loads.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <cmath>
#include <map>

namespace cdca {
namespace {

using Problems = std::vector<Problem>;

/// Supports at a point take the nearest node.
Vec2 nearest_node(const DomainSpec& domain, const Vec2& at) {
  const Vec2 cells(domain.cells[0], domain.cells[1]);
  const Vec2 h = domain.size.cwiseQuotient(cells);
  return domain.origin +
         (at - domain.origin).cwiseQuotient(h).array().round().matrix().cwiseProduct(h);
}

std::string point_text(const Vec2& at) { return fmt::format("[{:.6g}, {:.6g}]", at.x(), at.y()); }

/// What is said twice about one component at one place.
class ConflictCheck {
 public:
  ConflictCheck(const ConfigNode& root, const CaseSpec& spec, Problems& problems)
      : blocks_(root.find("boundary")), spec_(spec), problems_(problems) {}

  void run() {
    for (std::size_t i = 0; i < spec_.boundaries.size(); ++i) {
      const auto& boundary = spec_.boundaries[i];
      for (const int axis : {0, 1}) {
        if (boundary.displacement[axis]) claim(i, "displacement", axis, support_place(boundary));
        if (boundary.traction[axis]) claim(i, "traction", axis, boundary_place(boundary));
        if (boundary.force[axis]) claim(i, "force", axis, "the point " + point_text(boundary.at));
      }
      if (boundary.pressure) claim(i, "pressure", -1, "the crack \"" + boundary.crack + "\"");
    }
  }

 private:
  std::string boundary_place(const BoundarySpec& boundary) const {
    static constexpr std::string_view names[] = {"left", "right", "bottom", "top"};
    return fmt::format("the side \"{}\"", names[static_cast<std::size_t>(boundary.side)]);
  }

  std::string support_place(const BoundarySpec& boundary) const {
    if (boundary.kind == BoundaryKind::side) return boundary_place(boundary);
    return "the node next to " + point_text(nearest_node(spec_.domain, boundary.at));
  }

  void claim(std::size_t block, const std::string& key, int axis, const std::string& place) {
    // A force and a support at one point do not exclude each other: the support takes the force.
    const auto kind = key == "force" || key == "pressure" ? key : "";
    const auto [first, is_new] =
        claims_.emplace(place + kind + std::to_string(axis), Claim{block, key});
    if (is_new) return;
    const auto component = axis < 0 ? "" : axis == 0 ? " in x" : " in y";
    const auto& node = *blocks_->items[block].find(key);
    const auto path = fmt::format("boundary[{}].{}", block, key);
    problems_.push_back(problem_at(
        axis < 0 ? node : node.items[static_cast<std::size_t>(axis)],
        axis < 0 ? path : fmt::format("{}[{}]", path, axis),
        fmt::format("A {}{} is given for {}, but boundary[{}] gives its {}{} already; allowed is "
                    "one of them.",
                    key, component, place, first->second.block, first->second.key, component)));
  }

  struct Claim {
    std::size_t block;
    std::string key;
  };

  const ConfigNode* blocks_;
  const CaseSpec& spec_;
  Problems& problems_;
  std::map<std::string, Claim> claims_;
};

using Motions = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// One row per held component: what it makes of a translation in x, one in y, and a rotation about
/// the body's middle (in units of its size, so that the columns compare).
Motions held_motions(const CaseSpec& spec) {
  const auto& domain = spec.domain;
  const Vec2 middle = domain.origin + 0.5 * domain.size;
  std::vector<Eigen::RowVector3d> rows;
  const auto hold = [&](const BoundarySpec& boundary, const Vec2& at) {
    const Vec2 turned = turned_left(at - middle) / domain.size.maxCoeff();
    if (boundary.displacement[0]) rows.emplace_back(1.0, 0.0, turned.x());
    if (boundary.displacement[1]) rows.emplace_back(0.0, 1.0, turned.y());
  };
  for (const auto& boundary : spec.boundaries) {
    if (boundary.kind == BoundaryKind::point) hold(boundary, nearest_node(domain, boundary.at));
    if (boundary.kind != BoundaryKind::side) continue;
    for (const auto& end : ends_of(domain, boundary.side)) hold(boundary, end);
  }
  Motions motions(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) motions.row(static_cast<Eigen::Index>(i)) = rows[i];
  return motions;
}

/// The motions that are left, as a part of a sentence; empty when the body is held.
std::string free_motions(const Motions& held) {
  constexpr double tolerance = 1e-9;
  if (held.rows() == 0) return "translation in x, translation in y and rotation";
  Eigen::FullPivLU<Motions> lu(held);
  lu.setThreshold(tolerance);
  const auto left = 3 - lu.rank();
  const bool free_x = held.col(0).cwiseAbs().maxCoeff() == 0.0;
  const bool free_y = held.col(1).cwiseAbs().maxCoeff() == 0.0;
  std::string text = free_x ? "translation in x" : "";
  if (free_y) text += std::string(text.empty() ? "" : " and ") + "translation in y";
  if (left > (free_x ? 1 : 0) + (free_y ? 1 : 0))
    text += std::string(text.empty() ? "" : " and ") + "rotation";
  return text;
}

}  // namespace

void check_supports(const ConfigNode& root, const CaseSpec& spec, std::vector<Problem>& problems) {
  if (spec.domain.size.minCoeff() <= 0.0 || spec.domain.cells[0] < 1 || spec.domain.cells[1] < 1)
    return;
  ConflictCheck(root, spec, problems).run();
  const auto motions = free_motions(held_motions(spec));
  if (motions.empty()) return;
  const auto* blocks = root.find("boundary");
  const auto message = fmt::format(
      "The supports leave the body free in {}; allowed are displacements that hold both "
      "translations and the rotation.",
      motions);
  problems.push_back(problem_at(blocks ? *blocks : root, "boundary", message));
  if (!blocks) problems.back().line = 0;
}

}  // namespace cdca
