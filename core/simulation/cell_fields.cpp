// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/cell_fields.hpp"

#include "core/base/errors.hpp"

#include <numeric>

namespace cdca {

CellFields fields_of_cells(const BasisContext& basis, std::span<const double> displacement,
                           std::span<const double> force) {
  CellFields rows;
  for (LocalId n = 0; n < basis.mesh.owned_nodes(); ++n) {
    const auto unknowns = basis.unknowns.of_cell(n);
    rows.nodes.push_back(basis.mesh.node_id(n));
    rows.counts.push_back(std::int64_t(unknowns.size()));
    for (const LocalId u : unknowns) {
      rows.displacement.push_back(displacement.empty() ? 0.0 : displacement[std::size_t(u)]);
      rows.force.push_back(force.empty() ? 0.0 : force[std::size_t(u)]);
    }
  }
  return rows;
}

namespace {

/// What goes to each rank, of one of the four lists.
template <class T>
std::vector<T> exchanged(const std::vector<std::vector<T>>& outgoing, Communicator& communicator) {
  std::vector<int> ranks(outgoing.size());
  std::iota(ranks.begin(), ranks.end(), 0);
  std::vector<Bytes> messages(outgoing.size());
  for (std::size_t r = 0; r < outgoing.size(); ++r)
    pack(messages[r], std::span<const T>(outgoing[r]));
  std::vector<T> incoming;
  for (const Bytes& message : communicator.exchange(ranks, messages)) {
    const auto values = unpack<T>(message);
    incoming.insert(incoming.end(), values.begin(), values.end());
  }
  return incoming;
}

}  // namespace

CellFields rows_for_owners(const CellFields& rows, const LocalMesh& mesh,
                           Communicator& communicator) {
  if (communicator.size() == 1) return rows;
  const auto ranks = std::size_t(communicator.size());
  std::vector<std::vector<std::int64_t>> nodes(ranks), counts(ranks);
  std::vector<std::vector<double>> displacement(ranks), force(ranks);
  std::size_t at = 0;
  for (std::size_t k = 0; k < rows.nodes.size(); ++k) {
    const auto owner = std::size_t(mesh.owner(mesh.grid().node_index(rows.nodes[k])));
    const auto end = at + std::size_t(rows.counts[k]);
    nodes[owner].push_back(rows.nodes[k]);
    counts[owner].push_back(rows.counts[k]);
    for (; at < end; ++at) {
      displacement[owner].push_back(rows.displacement[at]);
      force[owner].push_back(rows.force[at]);
    }
  }
  return {exchanged(nodes, communicator), exchanged(counts, communicator),
          exchanged(displacement, communicator), exchanged(force, communicator)};
}

void put_cells(const CellFields& rows, const BasisContext& basis, Communicator& communicator,
               std::span<double> displacement, std::span<double> force) {
  bool fits = rows.nodes.size() == std::size_t(basis.mesh.owned_nodes());
  std::size_t at = 0;
  for (std::size_t k = 0; fits && k < rows.nodes.size(); ++k) {
    const LocalId n = basis.mesh.find_node(basis.mesh.grid().node_index(rows.nodes[k]));
    if (n < 0 || !basis.mesh.owns(n)) {
      fits = false;
      break;
    }
    const auto unknowns = basis.unknowns.of_cell(n);
    fits = std::int64_t(unknowns.size()) == rows.counts[k];
    for (std::size_t i = 0; fits && i < unknowns.size(); ++i, ++at) {
      displacement[std::size_t(unknowns[i])] = rows.displacement[at];
      force[std::size_t(unknowns[i])] = rows.force[at];
    }
  }
  if (communicator.min(fits ? 1.0 : 0.0) < 1.0) {
    throw IoError("The checkpoint does not fit the case: its cells or their unknowns are others.");
  }
}

}  // namespace cdca
