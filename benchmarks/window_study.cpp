// SPDX-License-Identifier: BSD-3-Clause
/// How windows may be combined: one window round every tip on every scale, wider and wider, against
/// iterations of CG. Answers a question of docs/solver.md; the solver itself has other windows.
///
/// usage: bench_window_study NX CRACKS COARSEST_NODES RADIUS...; prints a line of comma-separated
/// values for every radius. 0 iterations: not converged in 100.
#include "benchmarks/assembled.hpp"
#include "benchmarks/plate_case.hpp"
#include "core/hierarchy/plain_cells.hpp"
#include "core/solver/conjugate_gradients.hpp"
#include "core/solver/multilevel.hpp"

#include <Eigen/SparseCholesky>

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace cdca::benchmarks {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Map = Eigen::Map<Vector>;
using ConstMap = Eigen::Map<const Vector>;

/// How the moves of windows are put together.
enum class Combination {
  added,     ///< all from the same forces, moves added up
  shared,    ///< the same, divided by the number of windows over a cell
  in_turn,   ///< one after the other, and on the way back in reverse
  one_order  ///< one after the other, the same way round there and back
};

struct Window {
  std::vector<LocalId> members;
  Eigen::SimplicialLDLT<Matrix> factor;
};

Matrix whole(const CellStiffness& cells) {
  const Assembled k(cells);
  const auto size = Eigen::Index(cells.owned());
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>> upper(
      size, size, Eigen::Index(k.row.size()), k.start.data(), k.row.data(), k.value.data());
  Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t> full(size, size);
  full = upper.selfadjointView<Eigen::Upper>();
  return full;
}

/// The largest eigenvalue of a product of two symmetric positive matrices.
template <class Work>
double largest_eigenvalue(Eigen::Index size, const Work& work) {
  Vector x = Vector::Random(size);
  double value = 0.0;
  for (int k = 0; k < 60; ++k) {
    x.normalize();
    x = work(x);
    value = x.norm();
  }
  return value;
}

/// A scale with the windows of this study, on top of one of the solver's.
class StudyScale final : public Scale {
 public:
  /// starts: unknowns round each tip; not_plain: unknowns that only windows move.
  StudyScale(const Scale& base, const std::vector<std::vector<LocalId>>& starts, int radius,
             const std::vector<char>& not_plain)
      : base_(base), k_(whole(dynamic_cast<const CellStiffness&>(base.cells()))) {
    held_.assign(std::size_t(k_.rows()), 0);
    for (const LocalId u : dynamic_cast<const CellStiffness&>(base.cells()).held())
      held_[std::size_t(u)] = 1;
    over_ = Vector::Zero(k_.rows());
    for (const auto& start : starts) add_window(start, radius);
    set_blocks(not_plain);
  }
  void combine(Combination how) { how_ = how; }
  int windows_over_a_cell() const { return int(over_.maxCoeff()); }
  /// Of all windows' moves added, times K: beyond 2 they overshoot.
  double largest_added() const {
    return largest_eigenvalue(k_.rows(), [this](const Vector& x) {
      Vector moves = Vector::Zero(x.size());
      add_moves(k_ * x, moves);
      return moves;
    });
  }

  const CellSystem& cells() const override { return base_.cells(); }
  void move_plain_cells(std::span<const double> forces, std::span<double> moves) const override {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const auto u = std::size_t(first_[b]);
      const Vec2 move = blocks_[b] * Vec2(forces[u], forces[u + 1]);
      moves[u] += move.x();
      moves[u + 1] += move.y();
    }
  }
  void start_plain_cells(std::span<const double> forces, std::span<double> moves) const override {
    std::fill(moves.begin(), moves.end(), 0.0);
    move_plain_cells(forces, moves);
  }
  void move_windows(SweepDirection direction, std::span<double> forces,
                    std::span<double> moves) const override {
    Map force(forces.data(), k_.rows()), all(moves.data(), k_.rows());
    if (how_ == Combination::added || how_ == Combination::shared) {
      const Vector share = how_ == Combination::added
                               ? Vector(Vector::Ones(k_.rows()))
                               : Vector(over_.cwiseMax(1.0).cwiseInverse().cwiseSqrt());
      Vector move = Vector::Zero(k_.rows());
      add_moves(share.cwiseProduct(force), move);
      move = share.cwiseProduct(move);
      all += move;
      force -= k_ * move;
      return;
    }
    const bool reverse = direction == SweepDirection::backward && how_ == Combination::in_turn;
    for (std::size_t w = 0; w < windows_.size(); ++w) {
      const Window& window = *windows_[reverse ? windows_.size() - 1 - w : w];
      const Vector move = window.factor.solve(Vector(force(window.members)));
      all(window.members) += move;
      for (std::size_t m = 0; m < window.members.size(); ++m) {
        for (Matrix::InnerIterator e(k_, window.members[m]); e; ++e)
          force[e.row()] -= e.value() * move[Eigen::Index(m)];
      }
    }
  }
  void forces_to_coarser(std::span<const double> forces, std::span<double> coarser) const override {
    base_.forces_to_coarser(forces, coarser);
  }
  void add_moves_of_coarser(std::span<double> coarser, std::span<double> moves) const override {
    base_.add_moves_of_coarser(coarser, moves);
  }
  void solve(std::span<const double> forces, std::span<double> moves) const override {
    base_.solve(forces, moves);
  }

 private:
  /// All cells within `radius` couplings of the start.
  void add_window(const std::vector<LocalId>& start, int radius) {
    std::vector<char> inside(std::size_t(k_.rows()), 0);
    std::vector<LocalId> front = start;
    for (const LocalId u : front) inside[std::size_t(u)] = 1;
    for (int step = 0; step < radius; ++step) {
      std::vector<LocalId> next;
      for (const LocalId u : front) {
        for (Matrix::InnerIterator e(k_, u); e; ++e) {
          char& there = inside[std::size_t(e.row())];
          if (!there) next.push_back(LocalId(e.row()));
          there = 1;
        }
      }
      front = std::move(next);
    }
    auto window = std::make_unique<Window>();
    std::vector<LocalId> place(inside.size(), -1);
    for (std::size_t u = 0; u < inside.size(); ++u) {
      if (!inside[u] || held_[u]) continue;
      place[u] = LocalId(window->members.size());
      window->members.push_back(LocalId(u));
      over_[Eigen::Index(u)] += 1;
    }
    std::vector<Eigen::Triplet<double>> triplets;
    for (const LocalId u : window->members) {
      for (Matrix::InnerIterator e(k_, u); e; ++e) {
        if (const LocalId row = place[std::size_t(e.row())]; row >= 0)
          triplets.emplace_back(row, place[std::size_t(u)], e.value());
      }
    }
    const auto size = Eigen::Index(window->members.size());
    Matrix inner(size, size);
    inner.setFromTriplets(triplets.begin(), triplets.end());
    window->factor.compute(inner);
    windows_.push_back(std::move(window));
  }

  /// Damped block Jacobi for all cells, cut or not.
  void set_blocks(const std::vector<char>& not_plain) {
    for (LocalId u = 0; u < LocalId(k_.rows()); u += 2) {
      if (not_plain[std::size_t(u)]) continue;
      Eigen::Matrix2d own;
      own << k_.coeff(u, u), k_.coeff(u, u + 1), k_.coeff(u + 1, u), k_.coeff(u + 1, u + 1);
      Eigen::Matrix2d inverse = own.inverse();
      for (Eigen::Index c = 0; c < 2; ++c) {
        if (!held_[std::size_t(u + c)]) continue;
        inverse.row(c).setZero();
        inverse.col(c).setZero();
      }
      first_.push_back(u);
      blocks_.push_back(inverse);
    }
    const double largest = largest_eigenvalue(k_.rows(), [this](const Vector& x) {
      const Vector forces = k_ * x;
      Vector moves = Vector::Zero(x.size());
      move_plain_cells({forces.data(), std::size_t(forces.size())},
                       {moves.data(), std::size_t(moves.size())});
      return moves;
    });
    for (auto& block : blocks_) block *= 4.0 / (3.0 * largest);
  }

  void add_moves(const Vector& force, Vector& moves) const {
    for (const auto& window : windows_)
      moves(window->members) += window->factor.solve(Vector(force(window->members)));
  }

  const Scale& base_;
  Matrix k_;
  std::vector<char> held_;
  std::vector<std::unique_ptr<Window>> windows_;
  Vector over_;  ///< windows over each unknown
  std::vector<LocalId> first_;
  std::vector<Eigen::Matrix2d> blocks_;
  Combination how_ = Combination::in_turn;
};

class StudyScales final : public Scales {
 public:
  StudyScales(const Model& model, int radius) : base_(model.hierarchy()) {
    for (std::size_t k = 0; k + 1 < base_.count(); ++k) {
      const auto unknowns = std::size_t(base_.scale(k).cells().owned());
      std::vector<char> not_plain(unknowns, 0);
      if (k == 0) {
        for (const LocalId n : model.unknowns().special_nodes()) {
          for (const TipUnknowns& tip : model.unknowns().tips(n))
            std::fill_n(not_plain.begin() + tip.first, 8, char(1));
        }
      }
      scales_.push_back(
          std::make_unique<StudyScale>(base_.scale(k), round_tips(model, k), radius, not_plain));
    }
  }
  std::size_t count() const override { return base_.count(); }
  const Scale& scale(std::size_t k) const override {
    return k < scales_.size() ? static_cast<const Scale&>(*scales_[k]) : base_.scale(k);
  }
  void combine(Combination how) {
    for (auto& scale : scales_) scale->combine(how);
  }
  const StudyScale& coarsest_with_windows() const { return *scales_.back(); }

 private:
  /// The corners of each tip's element: on one rank piece 0 of node n has the unknowns 2n, 2n + 1.
  static std::vector<std::vector<LocalId>> round_tips(const Model& model, std::size_t level) {
    StructuredGrid grid = model.grid();
    for (std::size_t k = 0; k < level; ++k) grid = grid.coarser();
    std::vector<std::vector<LocalId>> starts;
    for (const Crack& crack : model.registry().cracks()) {
      for (int end = 0; end < 2; ++end) {
        std::vector<LocalId> start;
        for (const GridIndex n : grid.corners(grid.element_at(grid.to_grid(crack.end_point(end)))))
          start.insert(start.end(), {LocalId(2 * grid.node(n)), LocalId(2 * grid.node(n) + 1)});
        starts.push_back(start);
      }
    }
    return starts;
  }

  const Hierarchy& base_;
  std::vector<std::unique_ptr<StudyScale>> scales_;
};

/// Steps of CG to 1e-8; 0 for none.
int iterations(const Model& model, StudyScales& scales, Combination how) {
  scales.combine(how);
  VCycle cycle(scales);
  std::vector<double> u;
  const auto forces = forces_of(model, u);
  std::fill(u.begin(), u.end(), 0.0);
  const double scale = std::sqrt(model.stiffness().dot(forces, forces));
  const SolverReport report =
      conjugate_gradients(model.stiffness(),
                          [&](const std::vector<double>& force, std::vector<double>& scratch,
                              std::vector<double>& move) { cycle(force, scratch, move); },
                          forces, u, scale, {1e-8, 1.0, 100});
  return report.converged ? report.iterations : 0;
}

void study(int nx, int cracks, int coarsest, const std::vector<int>& radii) {
  CaseSpec spec = plate_in_tension(nx, cracks);
  spec.solver.coarsest_nodes = coarsest;
  SerialCommunicator alone;
  Model model(spec, alone, Partitioner());
  model.build_stiffness();
  StructuredGrid last = model.grid();
  for (std::size_t k = 2; k < model.hierarchy().count(); ++k) last = last.coarser();
  for (const int radius : radii) {
    StudyScales scales(model, radius);
    std::printf("%d,%d,%d x %d,%d,%d,%.2f", nx, cracks, last.nx(), last.ny(), radius,
                scales.coarsest_with_windows().windows_over_a_cell(),
                scales.coarsest_with_windows().largest_added());
    for (const Combination how :
         {Combination::added, Combination::shared, Combination::in_turn, Combination::one_order})
      std::printf(",%d", iterations(model, scales, how));
    std::printf("\n");
  }
}

}  // namespace
}  // namespace cdca::benchmarks

int main(int argc, char** argv) {
  if (argc < 5) {
    std::puts(
        "nx,cracks,coarsest_windows_on,radius,windows_over_a_cell,largest_added,added,shared,"
        "in_turn,one_order");
    return argc == 1 ? 0 : 2;
  }
  std::vector<int> radii;
  for (int k = 4; k < argc; ++k) radii.push_back(std::atoi(argv[k]));
  cdca::benchmarks::study(std::atoi(argv[1]), std::atoi(argv[2]), std::atoi(argv[3]), radii);
  return 0;
}
