// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/hierarchy.hpp"

#include "core/base/sort_once.hpp"
#include "core/hierarchy/coarse_supports.hpp"

#include <algorithm>
#include <optional>

namespace cdca {

namespace {

std::vector<GlobalId> cells_of(const WindowPlans& plans) {
  std::vector<GlobalId> nodes;
  for (const WindowPlan& w : plans.windows)
    nodes.insert(nodes.end(), w.nodes.begin(), w.nodes.end());
  sort_once(nodes);
  return nodes;
}

std::vector<GlobalId> all_own(const LocalMesh& mesh) {
  std::vector<GlobalId> nodes;
  for (LocalId n = 0; n < mesh.owned_nodes(); ++n) nodes.push_back(mesh.node_id(n));
  return nodes;
}

}  // namespace

/// One scale. The finest borrows its cells, the others have their own.
class Hierarchy::Level final : public Scale {
 public:
  Level(const LocalMesh& mesh, const CellUnknowns& unknowns, const CellStiffness& cells)
      : mesh_(&mesh), unknowns_(&unknowns), cells_(&cells) {}

  /// A coarse scale. own_rows: cells of windows, or all cells of the coarsest.
  Level(const LocalMesh& mesh, std::unique_ptr<CoarseParts> parts, Communicator& communicator,
        const CellUnknowns::Kept* kept)
      : parts_(std::move(parts)),
        own_unknowns_(std::make_unique<CellUnknowns>(mesh, *parts_, std::vector<TipZone>(),
                                                     communicator, kept)),
        mesh_(&mesh),
        unknowns_(own_unknowns_.get()) {}

  const CellSystem& cells() const override { return *cells_; }
  void move_plain_cells(std::span<const double> forces, std::span<double> moves) const override {
    plain_.move(forces, moves);
  }
  void start_plain_cells(std::span<const double> forces, std::span<double> moves) const override {
    plain_.start(forces, moves);
  }
  void move_windows(SweepDirection direction, std::span<double> forces,
                    std::span<double> moves) const override {
    windows_->move(direction, forces, moves);
  }
  void forces_to_coarser(std::span<const double> forces, std::span<double> coarser) const override {
    transfer_->to_coarse(forces, next_->cells_->halo(), coarser);
  }
  void add_moves_of_coarser(std::span<double> coarser, std::span<double> moves) const override {
    transfer_->add_to_fine(coarser, next_->cells_->halo(), moves);
  }
  void solve(std::span<const double> forces, std::span<double> moves) const override {
    coarsest_->solve(forces, moves);
  }

  /// The halo of cells that have no stiffness yet.
  Halo halo(Communicator& communicator) const { return {communicator, unknowns_->shared(*mesh_)}; }
  void set_transfer(const ScaleParts& parts, const Level& next) {
    next_ = &next;
    transfer_ = std::make_unique<Transfer>(Transfer::Scale{*mesh_, *unknowns_, parts}, *next.mesh_,
                                           *next.unknowns_, *next.parts_);
  }
  void set_cells(std::vector<GlobalId> own_rows, const CoarseSupports& supports,
                 Communicator& communicator, const CarriedCells* carried) {
    CoarseElements elements(*mesh_, *unknowns_, *parts_);
    const auto at_points = supports.cells_at_points(*mesh_);
    own_rows.insert(own_rows.end(), at_points.begin(), at_points.end());
    own_cells_ = std::make_unique<CellStiffness>(*mesh_, *unknowns_, elements, supports.held(),
                                                 supports.springs(), own_rows, Sweeps::none,
                                                 communicator, carried);
    cells_ = own_cells_.get();
  }
  void set_smoother(const WindowPlans& plans, const std::vector<PlainStiffness>& whole_elements,
                    WindowFactors& factors, const Level* before, const CarriedCells* carried) {
    plain_ = PlainCells(*mesh_, *unknowns_, *cells_, whole_elements, plans.near_cracks);
    windows_ = std::make_unique<Windows>(plans, *mesh_, *unknowns_, *cells_, factors,
                                         before ? before->windows_.get() : nullptr, carried);
  }
  void set_coarsest(CoarsestFactor& factor) {
    coarsest_ = std::make_unique<CoarsestSolve>(*cells_, factor);
  }

  void turn_springs() { coarsest_->turn_springs(); }
  Eigen::MatrixXd compliance(std::size_t measures, const std::vector<Effect>& effects) const {
    return coarsest_->compliance(measures, effects);
  }

  CoarseParts* parts() const { return parts_.get(); }
  const CellStiffness& stiffness() const { return *cells_; }
  const CellUnknowns& unknowns() const { return *unknowns_; }
  const Transfer& transfer() const { return *transfer_; }

 private:
  std::unique_ptr<CoarseParts> parts_;
  std::unique_ptr<CellUnknowns> own_unknowns_;
  std::unique_ptr<CellStiffness> own_cells_;
  const LocalMesh* mesh_;
  const CellUnknowns* unknowns_;
  const CellStiffness* cells_ = nullptr;
  const Level* next_ = nullptr;
  PlainCells plain_;
  std::unique_ptr<Windows> windows_;
  std::unique_ptr<Transfer> transfer_;
  std::unique_ptr<CoarsestSolve> coarsest_;
};

void Hierarchy::LevelDeleter::operator()(Level* level) const { delete level; }

const Scale& Hierarchy::scale(std::size_t index) const { return *levels_[index]; }

void Hierarchy::turn_springs() { levels_.front()->turn_springs(); }

Eigen::MatrixXd Hierarchy::compliance(std::size_t measures,
                                      const std::vector<Effect>& effects) const {
  return levels_.front()->compliance(measures, effects);
}

std::vector<GlobalId> Hierarchy::plan(const BasisContext& basis) {
  if (is_coarsest(basis.mesh.grid())) return all_own(basis.mesh);
  finest_plans_ = plan_windows(basis.cuts, basis.zones, shape_.windows);
  return cells_of(finest_plans_);
}

void Hierarchy::lay_meshes(const LocalMesh& finest) {
  if (!meshes_.empty()) return;
  const LocalMesh* mesh = &finest;
  std::size_t scales = 0;
  for (StructuredGrid g = finest.grid(); !is_coarsest(g); g = g.coarser()) ++scales;
  meshes_.reserve(scales);
  while (!is_coarsest(mesh->grid())) {
    meshes_.push_back(mesh->coarser());
    mesh = &meshes_.back();
  }
}

void Hierarchy::build(const FinestScale& finest, const CellStiffness& cells) {
  const BasisContext& basis = finest.basis;
  Communicator& communicator = cells.communicator();
  const GridIndex body{basis.mesh.grid().nx(), basis.mesh.grid().ny()};
  lay_meshes(basis.mesh);
  factors_.begin_cycle();
  auto before = std::move(levels_);
  if (!finest.carried) before.clear();
  levels_.clear();
  const auto level_before = [&](std::size_t k) {
    return before.empty() ? nullptr : before[k].get();
  };
  const FaceSprings* faces = meshes_.empty() ? nullptr : finest.faces;
  finest_parts_ = std::make_unique<FinestParts>(basis.cuts, finest.elastic, faces);
  levels_.emplace_back(new Level(basis.mesh, basis.unknowns, cells));
  if (meshes_.empty()) {
    levels_[0]->set_coarsest(coarsest_factor_);
    return;
  }
  const PlainStiffness element = plain_stiffness(basis.mesh.grid().element_size(), finest.elastic);
  levels_[0]->set_smoother(finest_plans_, {element}, factors_, level_before(0), finest.carried);
  CoarseSupports supports(finest.held, finest.springs, point_softening(element, finest.elastic));
  const ScaleParts* finer = finest_parts_.get();
  ChangedElements changed;
  if (finest.carried) changed = finest.carried->changed();
  for (std::size_t k = 0; k < meshes_.size(); ++k) {
    auto own_parts = std::make_unique<CoarseParts>(*finer, int(k) + 1, body, finest.elastic);
    const Level* was = level_before(k + 1);
    std::optional<CellUnknowns::Kept> kept;
    if (was) {
      changed.cuts = parents_of(changed.cuts, finer->grid());
      changed.turned = parents_of(changed.turned, finer->grid());
      changed.functions = changed.cuts;  // there are no near-tip functions
      own_parts->take_over(*was->parts(), changed.cuts);
      kept.emplace(CellUnknowns::Kept{was->unknowns(), changed.cuts});
    }
    levels_.emplace_back(
        new Level(meshes_[k], std::move(own_parts), communicator, kept ? &*kept : nullptr));
    Level& level = *levels_.back();
    const CoarseParts& parts = *level.parts();
    levels_[k]->set_transfer(*finer, level);
    const Halo halo = level.halo(communicator);
    supports.coarsen(levels_[k]->stiffness(), [&](const FewValues& fine) {
      std::vector<double> sum(std::size_t(level.unknowns().count()), 0.0);
      levels_[k]->transfer().few_to_coarse(fine, halo, sum);
      return sum;
    });
    const bool coarsest = k + 1 == meshes_.size();
    std::optional<CarriedCells> carried;
    if (was) {
      carried.emplace(meshes_[k], was->unknowns(), was->stiffness(), level.unknowns(), changed,
                      supports.held(), supports.springs());
    }
    const CarriedCells* same = carried ? &*carried : nullptr;
    const WindowPlans plans = coarsest ? WindowPlans() : plan_windows(parts, {}, shape_.windows);
    level.set_cells(coarsest ? all_own(meshes_[k]) : cells_of(plans), supports, communicator, same);
    if (coarsest) {
      level.set_coarsest(coarsest_factor_);
    } else {
      level.set_smoother(plans, parts.whole_elements(), factors_, was, same);
    }
    finer = &parts;
  }
}

}  // namespace cdca
