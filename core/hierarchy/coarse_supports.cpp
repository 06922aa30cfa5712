// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/coarse_supports.hpp"

#include "core/base/marked.hpp"

#include <algorithm>
#include <numbers>

namespace cdca {

namespace {

/// Of the held unknowns those that are not coupled to a held one of the same direction.
std::vector<LocalId> stand_alone(const CellStiffness& cells, const std::vector<char>& held) {
  std::vector<char> everywhere = held;
  for (const LocalId u : cells.halo().ghosts_of(held)) everywhere[std::size_t(u)] = 1;
  std::vector<LocalId> alone;
  const StiffnessRows& rows = cells.rows();
  for (const LocalId u : cells.held()) {
    const auto row = std::size_t(rows.find(u));
    bool found = false;
    for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k) {
      const LocalId v = rows.column[k];
      // x and y take turns
      found = found || (v != u && (v - u) % 2 == 0 && everywhere[std::size_t(v)] != 0);
    }
    if (!found) alone.push_back(u);
  }
  return alone;
}

FewValues but_zeros(const std::vector<double>& values) {
  FewValues few;
  for (std::size_t u = 0; u < values.size(); ++u) {
    if (values[u] != 0.0) few.emplace_back(LocalId(u), values[u]);
  }
  return few;
}

}  // namespace

double point_softening(const PlainStiffness& element, const ElasticMatrix& elastic) {
  const double cell = 0.5 * element.trace();  // four elements, the mean of x and y
  return cell * std::numbers::ln2 / (4 * std::numbers::pi) *
         (1 / elastic(2, 2) + 1 / elastic(0, 0));
}

CoarseSupports::CoarseSupports(const std::vector<char>& held, const std::vector<double>& springs,
                               double softening)
    : held_(held), weak_(but_zeros(springs)), softening_(softening) {}

void CoarseSupports::coarsen(const CellStiffness& cells, const ToCoarse& to_coarse) {
  constexpr double rigid = 1e6;
  for (const LocalId u : stand_alone(cells, held_)) {
    held_[std::size_t(u)] = 0;
    points_.emplace_back(u, rigid);
  }
  std::sort(points_.begin(), points_.end());
  FewValues ones;
  for (const LocalId u : marked(held_)) ones.emplace_back(u, 1.0);
  const auto sums = to_coarse(ones);
  points_ = but_zeros(to_coarse(points_));
  held_.assign(sums.size(), 0);
  for (std::size_t u = 0; u < sums.size(); ++u) held_[u] = sums[u] > 0;
  std::erase_if(points_,
                [this](const auto& point) { return held_[std::size_t(point.first)] != 0; });
  for (auto& [u, stiffness] : points_) stiffness = 1 / (1 / stiffness + softening_);
  // a spring of four children weighs as much as theirs together
  double strength = 0.0;
  for (const auto& [u, share] : weak_) strength = std::max(strength, 4 * share);
  strength = cells.communicator().max(strength);
  if (strength == 0) return;
  weak_ = but_zeros(to_coarse(weak_));
  for (auto& [u, share] : weak_) share = strength;
}

std::vector<double> CoarseSupports::springs() const {
  if (points_.empty() && weak_.empty()) return {};
  std::vector<double> sum(held_.size(), 0.0);
  for (const auto* springs : {&points_, &weak_}) {
    for (const auto& [u, share] : *springs) sum[std::size_t(u)] += share;
  }
  return sum;
}

std::vector<GlobalId> CoarseSupports::cells_at_points(const LocalMesh& mesh) const {
  std::vector<GlobalId> nodes;
  for (const auto& [u, share] : points_) {
    if (u < 2 * mesh.owned_nodes()) nodes.push_back(mesh.node_id(u / 2));
  }
  return nodes;
}

}  // namespace cdca
