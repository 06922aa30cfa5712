// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/bodies.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <map>
#include <numeric>

namespace cdca {

namespace {

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : root_(n) { std::iota(root_.begin(), root_.end(), 0); }
  std::int64_t find(std::int64_t k) {
    while (root_[std::size_t(k)] != k)
      k = root_[std::size_t(k)] = root_[std::size_t(root_[std::size_t(k)])];
    return k;
  }
  void join(std::int64_t a, std::int64_t b) {
    a = find(a);
    b = find(b);
    root_[std::size_t(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<std::int64_t> root_;
};

/// What one rank knows of one of its connected sets.
struct LocalBody {
  std::int64_t label = 0;  ///< number of the set over all ranks
  std::int64_t pieces = 0;
  std::uint64_t marks = 0;
  double x = 0.0, y = 0.0;  ///< m
  double rigid[6] = {};     ///< upper triangle of the supports' hold on (u_x, u_y, turn)
};

struct SameBody {
  std::int64_t here;
  std::int64_t there;
};

bool holds_all(const double r[6]) {
  Eigen::Matrix3d m;
  m << r[0], r[1], r[2], r[1], r[3], r[4], r[2], r[4], r[5];
  const auto values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvalues();
  return values[0] > 1e-9 * std::max(values[2], 1e-300);
}

void add_hold(const BasisContext& c, LocalId node, int component, LocalBody& body) {
  const Vec2 centre = c.mesh.grid().origin() + 0.5 * c.mesh.grid().size();
  const Vec2 x =
      (c.mesh.grid().node_position(c.mesh.node(node)) - centre) / c.mesh.grid().size().norm();
  const Eigen::Vector3d row(component == 0, component == 1, component == 0 ? -x.y() : x.x());
  const Eigen::Matrix3d m = row * row.transpose();
  const double upper[6] = {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
  for (std::size_t k = 0; k < 6; ++k) body.rigid[k] += upper[k];
}

/// A place inside a piece, m.
Vec2 place_of(const BasisContext& c, LocalId node, int piece) {
  const auto elements = c.mesh.grid().elements_round(c.mesh.node(node));
  for (std::size_t slot = 0; slot < 4; ++slot) {
    const GridIndex e = elements[slot];
    if (!c.mesh.grid().has_element(e)) continue;
    for (int part = 0; part < c.cuts.parts(e); ++part) {
      if (c.unknowns.piece(node, slot, part) != piece) continue;
      const CutElement* cut = c.cuts.find(e);
      return c.mesh.grid().from_grid(Vec2(e.i, e.j) + (cut ? cut->place_in(part) : Vec2(0.5, 0.5)));
    }
  }
  return c.mesh.grid().node_position(c.mesh.node(node));
}

/// The pieces of this rank as one vertex each.
class PieceGraph {
 public:
  explicit PieceGraph(const BasisContext& c) : c_(c), sets_(0) {
    first_.push_back(0);
    for (LocalId n = 0; n < c.mesh.node_count(); ++n)
      first_.push_back(first_.back() + c.unknowns.pieces(n));
    sets_ = UnionFind(std::size_t(first_.back()));
    for (LocalId k = 0; k < c.mesh.element_count(); ++k) {
      const GridIndex e = c.mesh.element(k);
      const auto nodes = c.mesh.element_nodes(e);
      for (int part = 0; part < c.cuts.parts(e); ++part) {
        for (std::size_t a = 1; a < 4; ++a) {
          sets_.join(vertex(nodes[0], c.unknowns.piece(nodes[0], 2, part)),
                     vertex(nodes[a], c.unknowns.piece(nodes[a], (a + 2) % 4, part)));
        }
      }
    }
  }
  std::int64_t vertex(LocalId node, int piece) const { return first_[std::size_t(node)] + piece; }
  const std::vector<std::int64_t>& first() const { return first_; }
  std::int64_t set_of(LocalId node, int piece) { return sets_.find(vertex(node, piece)); }

 private:
  const BasisContext& c_;
  std::vector<std::int64_t> first_;
  UnionFind sets_;
};

/// Names of this rank's sets, unique over all ranks.
std::map<std::int64_t, std::int64_t> label_sets(const BasisContext& c, PieceGraph& graph,
                                                Communicator& communicator) {
  std::map<std::int64_t, std::int64_t> label;
  for (LocalId n = 0; n < c.mesh.node_count(); ++n) {
    for (int p = 0; p < c.unknowns.pieces(n); ++p) label.emplace(graph.set_of(n, p), 0);
  }
  std::vector<std::int64_t> counts(std::size_t(communicator.size()), 0);
  counts[std::size_t(communicator.rank())] = std::int64_t(label.size());
  communicator.sum(std::span<std::int64_t>(counts));
  std::int64_t next =
      std::accumulate(counts.begin(), counts.begin() + communicator.rank(), std::int64_t(0));
  for (auto& [set, name] : label) name = next++;
  return label;
}

/// The pieces of border cells belong to one set here and to one at the neighbour: the same body.
std::vector<SameBody> across_borders(const BasisContext& c, PieceGraph& graph,
                                     const std::map<std::int64_t, std::int64_t>& label,
                                     Communicator& communicator) {
  std::vector<int> ranks;
  std::vector<Bytes> outgoing;
  for (const SharedNodes& shared : c.mesh.shared()) {
    std::vector<std::int64_t> labels;
    for (const LocalId n : shared.owned) {
      for (int p = 0; p < c.unknowns.pieces(n); ++p) labels.push_back(label.at(graph.set_of(n, p)));
    }
    ranks.push_back(shared.rank);
    outgoing.emplace_back();
    pack(outgoing.back(), std::span<const std::int64_t>(labels));
  }
  std::vector<SameBody> same;
  const auto incoming = communicator.exchange(ranks, outgoing);
  for (std::size_t k = 0; k < incoming.size(); ++k) {
    const auto theirs = unpack<std::int64_t>(incoming[k]);
    std::size_t at = 0;
    for (const LocalId n : c.mesh.shared()[k].ghosts) {
      for (int p = 0; p < c.unknowns.pieces(n); ++p) {
        same.push_back({label.at(graph.set_of(n, p)), theirs[at++]});
      }
    }
  }
  const auto less = [](const SameBody& a, const SameBody& b) {
    return a.here != b.here ? a.here < b.here : a.there < b.there;
  };
  std::sort(same.begin(), same.end(), less);
  same.erase(std::unique(same.begin(), same.end(),
                         [](const SameBody& a, const SameBody& b) {
                           return a.here == b.here && a.there == b.there;
                         }),
             same.end());
  return communicator.agree(same, less);
}

}  // namespace

Bodies::Bodies(const BasisContext& c, const std::vector<char>& held, const Marks& marks,
               Communicator& communicator) {
  PieceGraph graph(c);
  const auto label = label_sets(c, graph, communicator);
  std::map<std::int64_t, LocalBody> mine;
  for (LocalId n = 0; n < c.mesh.owned_nodes(); ++n) {
    for (int p = 0; p < c.unknowns.pieces(n); ++p) {
      LocalBody& body = mine[label.at(graph.set_of(n, p))];
      if (body.pieces++ == 0) {
        const Vec2 x = place_of(c, n, p);
        body.x = x.x();
        body.y = x.y();
      }
      body.marks |= marks(n, p);
      const LocalId u = c.unknowns.of_piece(n, p);
      for (int component = 0; component < 2; ++component) {
        if (held[std::size_t(u + component)]) add_hold(c, n, component, body);
      }
    }
  }
  std::vector<LocalBody> records;
  for (auto& [name, body] : mine) {
    body.label = name;
    records.push_back(body);
  }
  const auto all = communicator.agree(
      records, [](const LocalBody& a, const LocalBody& b) { return a.label < b.label; });
  const auto same = across_borders(c, graph, label, communicator);

  std::int64_t last = 0;
  for (const LocalBody& body : all) last = std::max(last, body.label);
  for (const SameBody& s : same) last = std::max({last, s.here, s.there});
  UnionFind sets(std::size_t(last + 1));
  for (const SameBody& s : same) sets.join(s.here, s.there);
  std::map<std::int64_t, LocalBody> merged;
  for (const LocalBody& body : all) {
    LocalBody& into = merged[sets.find(body.label)];
    if (into.pieces == 0) into.x = body.x, into.y = body.y;
    into.pieces += body.pieces;
    into.marks |= body.marks;
    for (std::size_t k = 0; k < 6; ++k) into.rigid[k] += body.rigid[k];
  }
  std::map<std::int64_t, std::size_t> number;
  for (const auto& [name, body] : merged) {
    number[name] = list_.size();
    list_.push_back({Vec2(body.x, body.y), body.pieces, holds_all(body.rigid), body.marks});
  }
  first_ = graph.first();
  for (LocalId n = 0; n < c.mesh.node_count(); ++n) {
    for (int p = 0; p < c.unknowns.pieces(n); ++p) {
      of_vertex_.push_back(number.at(sets.find(label.at(graph.set_of(n, p)))));
    }
  }
}

}  // namespace cdca
