// SPDX-License-Identifier: BSD-3-Clause
/// Rows of own stiffness, and how they are added up.
#pragma once

#include "core/base/types.hpp"

#include <Eigen/Dense>

#include <deque>
#include <span>
#include <vector>

namespace cdca {

/// Rows of own stiffness: for each listed unknown the unknowns that it is coupled to.
struct StiffnessRows {
  std::vector<LocalId> unknown;  ///< one per row, ascending
  std::vector<std::size_t> start{0};
  std::vector<LocalId> column;
  std::vector<double> value;

  /// Sum of value times x of one row, over the columns below `end`.
  double times(std::size_t row, std::span<const double> x, LocalId end) const;
  /// Row number of an unknown, or -1.
  std::ptrdiff_t find(LocalId unknown) const;
  /// Appends where the values of a matrix over some unknowns go, column by column. Their places
  /// must be there; `nowhere` for rows that are not, and for ghosts on ghosts.
  void append_places(const std::vector<LocalId>& unknowns, LocalId owned,
                     std::vector<std::size_t>& places) const;
  static constexpr auto nowhere = std::size_t(-1);
};

/// Adds up rows of cells from the matrices of elements, part by part.
class RowSum {
 public:
  void add(std::span<const LocalId> unknowns, Eigen::MatrixXd matrix);
  /// Of an element without cracks; the matrix has to stay where it is.
  void refer_to(std::span<const LocalId> unknowns, const Eigen::Matrix<double, 8, 8>& matrix);

  /// Makes places for a matrix over these unknowns that is added later.
  void make_places(std::span<const LocalId> unknowns);
  /// The rows of all wanted unknowns (flags); entries of ghosts on ghosts are left out. Entries of
  /// the same place are added up in the order in which they came, so that the sums are bit for bit
  /// the same whatever the numbers of the unknowns.
  StiffnessRows rows(const std::vector<char>& wanted, LocalId owned) const;

 private:
  struct Addend {
    std::size_t first;  ///< of its unknowns
    std::size_t size;
    const double* matrix;  ///< by columns; null for zeros
  };
  /// A row of an addend.
  struct Part {
    const Addend* addend;
    std::size_t row;
  };
  void append(std::span<const LocalId> unknowns, const double* matrix);
  /// The parts of row u end at end[u] and begin at the end of the row before. unknowns: of all
  /// addends; wanted: flags of unknowns.
  std::vector<Part> parts_by_unknown(const std::vector<LocalId>& unknowns,
                                     const std::vector<char>& wanted,
                                     std::vector<std::size_t>& end) const;

  std::deque<Eigen::MatrixXd> made_;
  std::vector<Addend> addends_;
  std::vector<LocalId> unknowns_;  ///< of one addend after the other
};

}  // namespace cdca
