// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/idle_functions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace cdca {

namespace {

constexpr std::size_t cells_of_element = 4;

/// Unknowns, ascending, with their numbers in a block.
using Numbered = std::vector<std::pair<LocalId, Eigen::Index>>;

/// visit(a, b, k): value k of the rows couples the unknowns with numbers a and b.
template <class Visit>
void for_entries(const Numbered& block, const StiffnessRows& rows, Visit&& visit) {
  for (const auto& [unknown, a] : block) {
    const std::ptrdiff_t row = rows.find(unknown);
    if (row < 0) continue;
    const auto end = rows.column.begin() + std::ptrdiff_t(rows.start[std::size_t(row) + 1]);
    auto at = std::lower_bound(rows.column.begin() + std::ptrdiff_t(rows.start[std::size_t(row)]),
                               end, block.front().first);
    for (const auto& [other, b] : block) {
      while (at != end && *at < other) ++at;
      if (at == end) break;
      if (*at == other) visit(a, b, std::size_t(at - rows.column.begin()));
    }
  }
}

/// The stiffness that holds what strains nothing, or 0 all over.
Eigen::MatrixXd hold_of(const Eigen::MatrixXd& own) {
  constexpr double idle = 1e-10, well_apart = 1e-7;
  // most blocks are far from that, which their factor tells at less cost
  const Eigen::LLT<Eigen::MatrixXd> factor(own);
  const auto pivots = factor.matrixLLT().diagonal().array().square();
  Eigen::MatrixXd hold = Eigen::MatrixXd::Zero(own.rows(), own.cols());
  if (factor.info() == Eigen::Success && (pivots > well_apart * own.diagonal().maxCoeff()).all())
    return hold;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> pairs(own);
  const double largest = pairs.eigenvalues()[own.rows() - 1];
  for (Eigen::Index k = 0; k < own.rows() && pairs.eigenvalues()[k] < idle * largest; ++k)
    hold += largest * pairs.eigenvectors().col(k) * pairs.eigenvectors().col(k).transpose();
  return hold;
}

class IdleFunctions {
 public:
  IdleFunctions(const LocalMesh& mesh, const CellUnknowns& unknowns, const StiffnessRows& rows,
                Communicator& communicator)
      : mesh_(mesh), unknowns_(unknowns), rows_(rows), communicator_(communicator) {}

  std::vector<AddedStiffness> holds() {
    for (const LocalId n : unknowns_.special_nodes()) {
      std::vector<LocalId> block;
      for (const TipUnknowns& tip : unknowns_.tips(n)) append(tip, block);
      if (mesh_.owns(n)) hold(numbered(std::move(block)));
    }
    hold_zones();
    return std::move(holds_);
  }

 private:
  /// A cell that this rank owns, of a zone.
  struct ZoneCell {
    std::int64_t zone, rank;
    GlobalId node;
  };
  using ZoneCells = std::span<const ZoneCell>;

  static void append(const TipUnknowns& tip, std::vector<LocalId>& block) {
    for (LocalId k = 0; k < tip.count; ++k) block.push_back(tip.first + k);
  }
  static Numbered numbered(std::vector<LocalId> block) {
    std::sort(block.begin(), block.end());
    Numbered numbers;
    for (const LocalId u : block) numbers.emplace_back(u, Eigen::Index(numbers.size()));
    return numbers;
  }

  /// The cells of all zones with no more cells than an element has; zone by zone, in order of node,
  /// the same on every rank.
  std::vector<ZoneCell> cells_of_small_zones() const {
    std::vector<ZoneCell> mine;
    std::int64_t zones = 0;
    for (const LocalId n : unknowns_.special_nodes()) {
      for (const TipUnknowns& tip : unknowns_.tips(n)) {
        zones = std::max(zones, std::int64_t(tip.zone) + 1);
        if (mesh_.owns(n)) mine.push_back({tip.zone, communicator_.rank(), mesh_.node_id(n)});
      }
    }
    std::vector<std::int64_t> cells(std::size_t(communicator_.max(double(zones))), 0);
    for (const ZoneCell& c : mine) ++cells[std::size_t(c.zone)];
    communicator_.sum(std::span<std::int64_t>(cells));
    std::erase_if(mine, [&cells](const ZoneCell& c) {
      return cells[std::size_t(c.zone)] > std::int64_t(cells_of_element);
    });
    return communicator_.agree(mine, [](const ZoneCell& a, const ZoneCell& b) {
      return std::tie(a.zone, a.node) < std::tie(b.zone, b.node);
    });
  }

  void hold_zones() {
    const std::vector<ZoneCell> cells = cells_of_small_zones();
    std::vector<ZoneCells> shared;
    for (std::size_t first = 0, end = 0; first < cells.size(); first = end) {
      while (end < cells.size() && cells[end].zone == cells[first].zone) ++end;
      const ZoneCells zone(cells.data() + first, end - first);
      const auto here = std::count_if(
          zone.begin(), zone.end(), [&](const ZoneCell& c) { return c.rank == zone.front().rank; });
      if (here < std::ptrdiff_t(zone.size())) {
        shared.push_back(zone);
      } else if (zone.front().rank == communicator_.rank()) {
        std::vector<LocalId> block;
        for (const ZoneCell& c : zone) append(*tip_of(c), block);
        hold(numbered(std::move(block)));
      }
    }
    hold_shared(shared);
  }

  /// The unknowns of the cell; null where this rank does not see it.
  const TipUnknowns* tip_of(const ZoneCell& cell) const {
    const LocalId n = mesh_.find_node(mesh_.grid().node_index(cell.node));
    if (n < 0) return nullptr;
    for (const TipUnknowns& tip : unknowns_.tips(n)) {
      if (tip.zone == cell.zone) return &tip;
    }
    return nullptr;
  }

  /// Of zones with cells of several ranks every rank adds the rows of its own cells to the block.
  void hold_shared(const std::vector<ZoneCells>& zones) {
    constexpr Eigen::Index of_cell = 8, size = of_cell * Eigen::Index(cells_of_element);
    using Block = Eigen::Matrix<double, size, size>;
    std::vector<double> values(zones.size() * std::size_t(Block::SizeAtCompileTime), 0.0);
    const auto block_of = [&](std::size_t z) {
      return Eigen::Map<Block>(values.data() + z * std::size_t(Block::SizeAtCompileTime));
    };
    std::vector<Numbered> numbers(zones.size());
    for (std::size_t z = 0; z < zones.size(); ++z) {
      for (std::size_t c = 0; c < zones[z].size(); ++c) {
        const TipUnknowns* tip = tip_of(zones[z][c]);
        for (LocalId k = 0; tip && k < tip->count; ++k)
          numbers[z].emplace_back(tip->first + k, of_cell * Eigen::Index(c) + k);
      }
      std::sort(numbers[z].begin(), numbers[z].end());
      Eigen::Map<Block> block = block_of(z);
      for_entries(numbers[z], rows_, [&](Eigen::Index a, Eigen::Index b, std::size_t k) {
        if (zones[z][std::size_t(a / of_cell)].rank == communicator_.rank())
          block(a, b) = rows_.value[k];
      });
    }
    communicator_.sum(std::span<double>(values));
    for (std::size_t z = 0; z < zones.size(); ++z) {
      std::vector<Eigen::Index> used;  // cells with modes have fewer unknowns
      for (Eigen::Index a = 0; a < size; ++a) {
        if (block_of(z)(a, a) > 0.0) used.push_back(a);
      }
      Eigen::MatrixXd hold = Eigen::MatrixXd::Zero(size, size);
      hold(used, used) = hold_of(block_of(z)(used, used));
      add(hold, numbers[z]);
    }
  }

  void hold(const Numbered& block) {
    if (block.empty()) return;
    const auto size = Eigen::Index(block.size());
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(size, size);
    for_entries(block, rows_,
                [&](Eigen::Index a, Eigen::Index b, std::size_t k) { own(a, b) = rows_.value[k]; });
    add(hold_of(own), block);
  }

  void add(const Eigen::MatrixXd& hold, const Numbered& block) {
    if (hold.isZero(0.0)) return;
    for_entries(block, rows_, [&](Eigen::Index a, Eigen::Index b, std::size_t k) {
      holds_.push_back({k, hold(a, b)});
    });
  }

  const LocalMesh& mesh_;
  const CellUnknowns& unknowns_;
  const StiffnessRows& rows_;
  Communicator& communicator_;
  std::vector<AddedStiffness> holds_;
};

}  // namespace

std::vector<AddedStiffness> holds_of_idle_functions(const LocalMesh& mesh,
                                                    const CellUnknowns& unknowns,
                                                    const StiffnessRows& rows,
                                                    Communicator& communicator) {
  return IdleFunctions(mesh, unknowns, rows, communicator).holds();
}

}  // namespace cdca
