// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/assembled.hpp"

namespace cdca::benchmarks {

Assembled::Assembled(const CellStiffness& cells)
    : cells_(cells),
      held_(std::size_t(cells.count()), 0),
      run_of_(std::size_t(cells.count()), -1),
      row_of_(std::size_t(cells.count()), -1) {
  for (const LocalId u : cells.held()) held_[std::size_t(u)] = 1;
  const auto& runs = cells.regular().runs();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (LocalId k = 0; k < 2 * runs[r].count; ++k)
      run_of_[std::size_t(2 * runs[r].node + k)] = int(r);
  }
  for (std::size_t r = 0; r < cells.rows().unknown.size(); ++r)
    row_of_[std::size_t(cells.rows().unknown[r])] = int(r);
  for (LocalId u = 0; u < cells.owned(); ++u) {
    add_column(u);
    start.push_back(std::int64_t(row.size()));
  }
}

void Assembled::add_column(LocalId u) {
  if (held_[std::size_t(u)]) {
    row.push_back(u);
    value.push_back(1.0);
    return;
  }
  const auto add = [&](LocalId v, double entry) {
    if (v > u || held_[std::size_t(v)]) return;
    row.push_back(v);
    value.push_back(entry);
  };
  if (run_of_[std::size_t(u)] < 0) {
    const StiffnessRows& rows = cells_.rows();
    const auto own = std::size_t(row_of_[std::size_t(u)]);
    for (std::size_t k = rows.start[own]; k < rows.start[own + 1]; ++k)
      add(rows.column[k], rows.value[k]);
    return;
  }
  const RegularRun& run = cells_.regular().runs()[std::size_t(run_of_[std::size_t(u)])];
  const LocalId along = u / 2 - run.node;
  const LocalId nodes[3] = {run.below + along, run.node + along, run.above + along};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t m = 0; m < 6; ++m) {
      add(2 * (nodes[r] - 1) + LocalId(m), cells_.regular().stencil()[r][std::size_t(u % 2)][m]);
    }
  }
}

std::vector<double> forces_of(const Model& model, std::vector<double>& prescribed) {
  const CellStiffness& cells = model.stiffness();
  std::vector<double> product(std::size_t(cells.count()), 0.0);
  prescribed.assign(product.size(), 0.0);
  model.supports().prescribe(model.spec().boundaries, 1.0, prescribed);
  cells.apply(prescribed, product);
  for (double& f : product) f = -f;
  cells.clear_held(product);
  return product;
}

}  // namespace cdca::benchmarks
