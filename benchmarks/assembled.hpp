// SPDX-License-Identifier: BSD-3-Clause
/// The system that the cells stand for, put together: for comparisons only.
#pragma once

#include "core/simulation/model.hpp"

#include <cstdint>
#include <vector>

namespace cdca::benchmarks {

/// The upper triangle of K column by column (or the lower one row by row), on one rank; rows and
/// columns of held unknowns are those of the identity.
class Assembled {
 public:
  explicit Assembled(const CellStiffness& cells);
  std::vector<std::int64_t> start{0}, row;
  std::vector<double> value;

 private:
  void add_column(LocalId u);

  const CellStiffness& cells_;
  std::vector<char> held_;
  std::vector<int> run_of_, row_of_;
};

/// The right-hand side of a model with prescribed displacements at load factor 1, as
/// find_equilibrium() has it; held unknowns 0. prescribed: out, the values of the held ones.
std::vector<double> forces_of(const Model& model, std::vector<double>& prescribed);

}  // namespace cdca::benchmarks
