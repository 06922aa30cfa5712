// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/bodies.hpp"

#include "core/base/marked.hpp"
#include "core/cells/element_stiffness.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

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
  GlobalId node = 0;        ///< the first of the grid that has a piece in it
  double x = 0.0, y = 0.0;  ///< a place in that piece, m
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

/// The pieces of this rank: a vertex for each, but one for all plain cells that stand side by side.
class PieceGraph {
 public:
  explicit PieceGraph(const BasisContext& c)
      : c_(c),
        plain_(runs_without(c.mesh.own_runs(), c.unknowns.special_nodes())),
        first_(std::size_t(c.mesh.node_count())),
        sets_(0) {
    for (const NodeRun& run : plain_)
      std::fill_n(first_.begin() + run.first, run.count, vertices_++);
    const auto add_cell = [&](LocalId n) {
      first_[std::size_t(n)] = vertices_;
      vertices_ += c.unknowns.pieces(n);
    };
    for (const LocalId n : c.unknowns.special_nodes()) {
      if (c.mesh.owns(n)) add_cell(n);
    }
    for (LocalId ghost = c.mesh.owned_nodes(); ghost < c.mesh.node_count(); ++ghost)
      add_cell(ghost);
    sets_ = UnionFind(std::size_t(vertices_));
    join_rows();
    join_elements();
  }
  std::int32_t vertices() const { return vertices_; }
  std::int32_t vertex(LocalId node, int piece) const { return first_[std::size_t(node)] + piece; }
  const std::vector<std::int32_t>& first() const { return first_; }
  /// Runs of plain own cells.
  const std::vector<NodeRun>& plain() const { return plain_; }
  /// The smallest vertex of the set.
  std::int32_t set_of(std::int32_t vertex) { return std::int32_t(sets_.find(vertex)); }

 private:
  /// Plain cells of one row with those above.
  void join_rows() {
    auto above = plain_.begin();
    for (const NodeRun& run : plain_) {
      while (above != plain_.end() &&
             (above->at.j <= run.at.j ||
              (above->at.j == run.at.j + 1 && above->end_column() <= run.at.i)))
        ++above;
      for (auto over = above;
           over != plain_.end() && over->at.j == run.at.j + 1 && over->at.i < run.end_column();
           ++over)
        sets_.join(vertex(run.first, 0), vertex(over->first, 0));
    }
  }

  /// All that meet in an element near cracks or with a ghost.
  void join_elements() {
    for (const GlobalId id : elements_near_cracks(c_.mesh, c_.cuts, c_.unknowns))
      join_element(c_.mesh.grid().element_index(id));
    for (LocalId ghost = c_.mesh.owned_nodes(); ghost < c_.mesh.node_count(); ++ghost) {
      for (const GridIndex e : c_.mesh.grid().elements_round(c_.mesh.node(ghost))) {
        if (c_.mesh.find_element(e) >= 0) join_element(e);
      }
    }
  }

  void join_element(GridIndex e) {
    const auto nodes = c_.mesh.element_nodes(e);
    for (int part = 0; part < c_.cuts.parts(e); ++part) {
      for (std::size_t a = 1; a < 4; ++a) {
        sets_.join(vertex(nodes[0], c_.unknowns.piece(nodes[0], 2, part)),
                   vertex(nodes[a], c_.unknowns.piece(nodes[a], (a + 2) % 4, part)));
      }
    }
  }

  const BasisContext& c_;
  std::vector<NodeRun> plain_;
  std::vector<std::int32_t> first_;
  std::int32_t vertices_ = 0;
  UnionFind sets_;
};

/// This rank's sets: names from `first` on, unique over all ranks.
struct SetNames {
  std::int64_t first = 0;
  std::int64_t count = 0;
  std::vector<std::int64_t> of_vertex;
};

SetNames name_sets(PieceGraph& graph, Communicator& communicator) {
  SetNames names;
  for (std::int32_t v = 0; v < graph.vertices(); ++v) names.count += graph.set_of(v) == v;
  std::vector<std::int64_t> counts(std::size_t(communicator.size()), 0);
  counts[std::size_t(communicator.rank())] = names.count;
  communicator.sum(std::span<std::int64_t>(counts));
  names.first =
      std::accumulate(counts.begin(), counts.begin() + communicator.rank(), std::int64_t(0));
  std::int64_t next = names.first;
  for (std::int32_t v = 0; v < graph.vertices(); ++v) {
    const std::int32_t set = graph.set_of(v);
    names.of_vertex.push_back(set == v ? next++ : names.of_vertex[std::size_t(set)]);
  }
  return names;
}

/// The pieces of border cells belong to one set here and to one at the neighbour: the same body.
std::vector<SameBody> across_borders(const BasisContext& c, const PieceGraph& graph,
                                     const SetNames& names, Communicator& communicator) {
  const auto name_of = [&](LocalId n, int p) {
    return names.of_vertex[std::size_t(graph.vertex(n, p))];
  };
  std::vector<int> ranks;
  std::vector<Bytes> outgoing;
  for (const SharedNodes& shared : c.mesh.shared()) {
    std::vector<std::int64_t> own;
    for (const LocalId n : shared.owned) {
      for (int p = 0; p < c.unknowns.pieces(n); ++p) own.push_back(name_of(n, p));
    }
    ranks.push_back(shared.rank);
    outgoing.emplace_back();
    pack(outgoing.back(), std::span<const std::int64_t>(own));
  }
  std::vector<SameBody> same;
  const auto incoming = communicator.exchange(ranks, outgoing);
  for (std::size_t k = 0; k < incoming.size(); ++k) {
    const auto theirs = unpack<std::int64_t>(incoming[k]);
    std::size_t at = 0;
    for (const LocalId n : c.mesh.shared()[k].ghosts) {
      for (int p = 0; p < c.unknowns.pieces(n); ++p) same.push_back({name_of(n, p), theirs[at++]});
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

/// What this rank knows of its sets that have own cells.
std::vector<LocalBody> own_bodies(const BasisContext& c, const PieceGraph& graph,
                                  const SetNames& names, const std::vector<char>& held,
                                  const std::vector<PieceMarks>& marks) {
  std::vector<LocalBody> bodies(std::size_t(names.count));
  const auto body_of = [&](LocalId n, int p) -> LocalBody& {
    const std::int64_t name = names.of_vertex[std::size_t(graph.vertex(n, p))];
    bodies[std::size_t(name - names.first)].label = name;
    return bodies[std::size_t(name - names.first)];
  };
  // cells side by side count together, and lie where the first of them does
  const auto add = [&](LocalId n, int p, LocalId count) {
    LocalBody& body = body_of(n, p);
    const GlobalId node = c.mesh.node_id(n);
    if (body.pieces == 0 || node < body.node) {
      const Vec2 x = place_of(c, n, p);
      body.node = node;
      body.x = x.x();
      body.y = x.y();
    }
    body.pieces += count;
  };
  for (const NodeRun& run : graph.plain()) add(run.first, 0, run.count);
  for (const LocalId u : marked({held.data(), std::size_t(2 * c.mesh.owned_nodes())}))
    add_hold(c, u / 2, u % 2, body_of(u / 2, 0));
  for (const LocalId n : c.unknowns.special_nodes()) {
    if (!c.mesh.owns(n)) break;
    for (int p = 0; p < c.unknowns.pieces(n); ++p) {
      add(n, p, 1);
      const LocalId u = c.unknowns.of_piece(n, p);
      for (int component = 0; p > 0 && component < 2; ++component) {
        if (held[std::size_t(u + component)]) add_hold(c, n, component, body_of(n, p));
      }
    }
  }
  for (const PieceMarks& m : marks) {
    if (c.mesh.owns(m.node)) body_of(m.node, m.piece).marks |= m.bits;
  }
  std::erase_if(bodies, [](const LocalBody& body) { return body.pieces == 0; });
  return bodies;
}

}  // namespace

Bodies::Bodies(const BasisContext& c, const std::vector<char>& held,
               const std::vector<PieceMarks>& marks, Communicator& communicator) {
  PieceGraph graph(c);
  const SetNames names = name_sets(graph, communicator);
  const auto all =
      communicator.agree(own_bodies(c, graph, names, held, marks),
                         [](const LocalBody& a, const LocalBody& b) { return a.label < b.label; });
  const auto same = across_borders(c, graph, names, communicator);

  std::int64_t last = 0;
  for (const LocalBody& body : all) last = std::max(last, body.label);
  for (const SameBody& s : same) last = std::max({last, s.here, s.there});
  UnionFind sets(std::size_t(last + 1));
  for (const SameBody& s : same) sets.join(s.here, s.there);
  std::map<std::int64_t, LocalBody> merged;
  for (const LocalBody& body : all) {
    LocalBody& into = merged[sets.find(body.label)];
    if (into.pieces == 0 || body.node < into.node)
      into.node = body.node, into.x = body.x, into.y = body.y;
    into.pieces += body.pieces;
    into.marks |= body.marks;
    for (std::size_t k = 0; k < 6; ++k) into.rigid[k] += body.rigid[k];
  }
  // in an order that does not depend on who owns what
  std::vector<std::pair<std::int64_t, LocalBody>> order(merged.begin(), merged.end());
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::tie(a.second.node, a.second.y, a.second.x) <
           std::tie(b.second.node, b.second.y, b.second.x);
  });
  std::map<std::int64_t, std::size_t> number;
  for (const auto& [name, body] : order) {
    number[name] = list_.size();
    list_.push_back({Vec2(body.x, body.y), body.pieces, holds_all(body.rigid), body.marks});
  }
  first_ = graph.first();
  for (const std::int64_t name : names.of_vertex) of_vertex_.push_back(number.at(sets.find(name)));
}

}  // namespace cdca
