// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/coarse_supports.hpp"

#include <algorithm>
#include <numbers>

namespace cdca {

namespace {

/// Of the held unknowns those that are not coupled to a held one of the same direction.
std::vector<LocalId> stand_alone(const CellStiffness& cells, const std::vector<char>& held) {
  std::vector<double> everywhere(held.begin(), held.end());
  cells.halo().copy_state(everywhere);
  std::vector<LocalId> alone;
  const StiffnessRows& rows = cells.rows();
  for (const LocalId u : cells.held()) {
    const auto row = std::size_t(rows.find(u));
    bool found = false;
    for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k) {
      const LocalId v = rows.column[k];
      // x and y take turns
      found = found || (v != u && (v - u) % 2 == 0 && everywhere[std::size_t(v)] > 0);
    }
    if (!found) alone.push_back(u);
  }
  return alone;
}

}  // namespace

double point_softening(const PlainStiffness& element, const ElasticMatrix& elastic) {
  const double cell = 0.5 * element.trace();  // four elements, the mean of x and y
  return cell * std::numbers::ln2 / (4 * std::numbers::pi) *
         (1 / elastic(2, 2) + 1 / elastic(0, 0));
}

CoarseSupports::CoarseSupports(const std::vector<char>& held, const std::vector<double>& springs,
                               double softening)
    : held_(held), weak_(springs), points_(held.size(), 0.0), softening_(softening) {}

void CoarseSupports::coarsen(const CellStiffness& cells, const ToCoarse& to_coarse) {
  constexpr double rigid = 1e6;
  for (const LocalId u : stand_alone(cells, held_)) {
    held_[std::size_t(u)] = 0;
    points_[std::size_t(u)] = rigid;
  }
  const auto sums = to_coarse(std::vector<double>(held_.begin(), held_.end()));
  points_ = to_coarse(points_);
  held_.resize(sums.size());
  for (std::size_t u = 0; u < sums.size(); ++u) {
    held_[u] = sums[u] > 0;
    points_[u] = held_[u] || points_[u] == 0 ? 0 : 1 / (1 / points_[u] + softening_);
  }
  // a spring of four children weighs as much as theirs together
  double strength = 0.0;
  for (const double s : weak_) strength = std::max(strength, 4 * s);
  strength = cells.communicator().max(strength);
  if (strength == 0) return;
  weak_ = to_coarse(weak_);
  for (double& s : weak_) s = s > 0 ? strength : 0;
}

std::vector<double> CoarseSupports::springs() const {
  std::vector<double> sum = points_;
  for (std::size_t u = 0; u < weak_.size(); ++u) sum[u] += weak_[u];
  const bool none = std::all_of(sum.begin(), sum.end(), [](double s) { return s == 0; });
  return none ? std::vector<double>() : sum;
}

std::vector<GlobalId> CoarseSupports::cells_at_points(const LocalMesh& mesh) const {
  std::vector<GlobalId> nodes;
  for (LocalId u = 0; u < 2 * mesh.owned_nodes(); ++u) {
    if (points_[std::size_t(u)] > 0) nodes.push_back(mesh.node_id(u / 2));
  }
  return nodes;
}

}  // namespace cdca
