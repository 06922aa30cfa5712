// SPDX-License-Identifier: BSD-3-Clause
/// From one scale to the next: forces to coarser cells, their moves back to finer ones.
#pragma once

#include "core/base/halo.hpp"
#include "core/hierarchy/coarse_parts.hpp"

#include <span>
#include <utility>
#include <vector>

namespace cdca {

/// Values of few unknowns of a scale, in order of unknowns; those of the others are 0.
using FewValues = std::vector<std::pair<LocalId, double>>;

/// Bilinear interpolation P. A fine piece takes its displacement from the coarse pieces that
/// contain it only, so none crosses a crack. Near-tip unknowns take part on the grid itself alone:
/// their rows of P are empty.
class Transfer {
 public:
  struct Scale {
    const LocalMesh& mesh;
    const CellUnknowns& unknowns;
    const ScaleParts& parts;
  };
  Transfer(const Scale& fine, const LocalMesh& coarse_mesh, const CellUnknowns& coarse_unknowns,
           const CoarseParts& coarse_parts);

  /// coarse = P^T fine, of own cells. Collective.
  void to_coarse(std::span<const double> fine, const Halo& halo, std::span<double> coarse) const;
  /// The same of few forces; coarse must be 0 before. Collective.
  void few_to_coarse(const FewValues& fine, const Halo& halo, std::span<double> coarse) const;
  /// fine += P coarse, on own cells. Collective.
  void add_to_fine(std::span<double> coarse, const Halo& halo, std::span<double> fine) const;

 private:
  /// Consecutive plain fine cells of one row; their parents are consecutive plain coarse cells.
  struct Run {
    LocalId fine = 0;
    LocalId count = 0;
    bool odd = false;   ///< the first cell lies between two columns of coarse cells
    LocalId below = 0;  ///< first parent in the row below or at the same height
    LocalId above = 0;  ///< in the row above; the same as below for even rows
  };
  struct Entry {
    LocalId fine;  ///< x; y follows
    LocalId coarse;
    double weight;
  };
  using Pair = Eigen::Array2d;  ///< x and y of one cell
  using Place = Eigen::Map<Pair>;
  using ConstPlace = Eigen::Map<const Pair>;
  static void gather_row(const Run& run, double share, const double* fine, double* coarse);
  template <class Coarse>
  static void spread_row(const Run& run, const Coarse& coarse, double* fine);
  /// plain: runs of own plain cells of both scales. Returns the fine ones that are in no run.
  std::vector<LocalId> find_runs(const LocalMesh& fine, const std::vector<NodeRun>& plain,
                                 const std::vector<NodeRun>& plain_coarse);
  void add_entries(const Scale& fine, LocalId node, const LocalMesh& coarse,
                   const CellUnknowns& unknowns, const CoarseParts& parts);

  std::vector<Run> runs_;
  std::vector<Entry> entries_;
};

}  // namespace cdca
