// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/idle_functions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <map>
#include <utility>

namespace cdca {

namespace {

void hold_idle(std::vector<LocalId> block, StiffnessRows& rows) {
  const bool has_rows =
      std::all_of(block.begin(), block.end(), [&rows](LocalId u) { return rows.find(u) >= 0; });
  if (!has_rows) return;
  std::sort(block.begin(), block.end());
  constexpr double idle = 1e-10, well_apart = 1e-7;
  const auto size = Eigen::Index(block.size());
  Eigen::MatrixXd own = Eigen::MatrixXd::Zero(size, size);
  const auto for_entries = [&](auto&& visit) {
    for (Eigen::Index a = 0; a < size; ++a) {
      const auto row = std::size_t(rows.find(block[std::size_t(a)]));
      const auto first = rows.column.begin() + std::ptrdiff_t(rows.start[row]);
      const auto end = rows.column.begin() + std::ptrdiff_t(rows.start[row + 1]);
      auto at = std::lower_bound(first, end, block.front());
      for (Eigen::Index b = 0; b < size; ++b) {
        while (at != end && *at < block[std::size_t(b)]) ++at;
        if (at == end) break;
        if (*at == block[std::size_t(b)])
          visit(a, b, rows.value[std::size_t(at - rows.column.begin())]);
      }
    }
  };
  for_entries([&](Eigen::Index a, Eigen::Index b, double value) { own(a, b) = value; });
  // most blocks are far from that, which their factor tells at less cost
  const Eigen::LLT<Eigen::MatrixXd> factor(own);
  const auto pivots = factor.matrixLLT().diagonal().array().square();
  if (factor.info() == Eigen::Success && (pivots > well_apart * own.diagonal().maxCoeff()).all())
    return;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> pairs(own);
  const double largest = pairs.eigenvalues()[size - 1];
  Eigen::MatrixXd hold = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index k = 0; k < size && pairs.eigenvalues()[k] < idle * largest; ++k) {
    hold += largest * pairs.eigenvectors().col(k) * pairs.eigenvectors().col(k).transpose();
  }
  if (hold.isZero(0.0)) return;
  for_entries([&](Eigen::Index a, Eigen::Index b, double& value) { value += hold(a, b); });
}

}  // namespace

void hold_idle_functions(const LocalMesh& mesh, const CellUnknowns& unknowns, StiffnessRows& rows) {
  constexpr std::size_t one_element = 4;
  struct Zone {
    std::size_t cells = 0;
    std::vector<LocalId> own;
  };
  std::map<int, Zone> zones;
  for (const LocalId n : unknowns.special_nodes()) {
    std::vector<LocalId> block;
    for (const TipUnknowns& tip : unknowns.tips(n)) {
      Zone& zone = zones[tip.zone];
      ++zone.cells;
      if (!mesh.owns(n)) continue;
      for (LocalId k = 0; k < tip.count; ++k) block.push_back(tip.first + k);
      if (zone.cells <= one_element)
        zone.own.insert(zone.own.end(), block.end() - tip.count, block.end());
    }
    if (!block.empty()) hold_idle(block, rows);
  }
  for (const auto& [number, zone] : zones) {
    if (zone.cells <= one_element && !zone.own.empty()) hold_idle(zone.own, rows);
  }
}

}  // namespace cdca
