// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/supports.hpp"

#include "core/cells/gauss.hpp"
#include "core/mechanics/side_walk.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <map>

namespace cdca {

namespace {

using Sample = HeldUnknown::Sample;

/// How one piece's value follows from the prescribed function.
struct Fit {
  bool at_node = false;  ///< the piece holds its node: take the function there
  int contributions = 0;
  std::vector<Sample> samples;
};

/// Pieces of a cell that reach its node: one, or several when a crack passes through the node.
std::vector<int> pieces_at_node(const BasisContext& c, GridIndex node, const CellPieces& pieces) {
  std::vector<int> found;
  const auto elements = c.mesh.grid().elements_round(node);
  for (std::size_t slot = 0; slot < 4; ++slot) {
    if (!c.mesh.grid().has_element(elements[slot])) continue;
    for (const int part : c.cuts.parts_at(elements[slot], Vec2(node.i, node.j))) {
      const int piece = pieces.piece[slot][std::size_t(part)];
      if (std::find(found.begin(), found.end(), piece) == found.end()) found.push_back(piece);
    }
  }
  return found;
}

/// Does the part that ends in this corner of the element hold the node alone?
bool node_is_inside(const BasisContext& c, GridIndex element, std::size_t corner, int part) {
  const GridIndex node = c.mesh.grid().corners(element)[corner];
  const CellPieces pieces = pieces_of(c.cuts, node);
  const int mine = pieces.piece[(corner + 2) % 4][std::size_t(part)];
  return pieces_at_node(c, node, pieces) == std::vector<int>{mine};
}

class SideFits {
 public:
  SideFits(const BasisContext& context, Side side) : c_(context), geometry_(geometry_of(side)) {
    for (const GridIndex e : elements_at(context.mesh, side)) {
      for (const SidePortion& p : context.cuts.side(e, geometry_.element_side)) {
        // slivers belong to the part across the crack, but the function there does not
        if (!p.closed) add(e, p);
      }
    }
  }
  /// Node, piece -> fit; own nodes only.
  const std::map<std::pair<LocalId, int>, Fit>& fits() const { return fits_; }

 private:
  void add(GridIndex e, const SidePortion& portion) {
    const std::size_t corner[2] = {geometry_.first_corner, geometry_.last_corner};
    const bool reaches[2] = {portion.t0 == 0.0, portion.t1 == 1.0};
    bool known[2];
    for (std::size_t k = 0; k < 2; ++k) {
      known[k] =
          reaches[k] && (!c_.cuts.touched(e) || node_is_inside(c_, e, corner[k], portion.part));
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const LocalId node = c_.mesh.element_nodes(e)[corner[k]];
      if (!c_.mesh.owns(node)) continue;
      Fit& fit = fits_[{node, c_.unknowns.piece(node, (corner[k] + 2) % 4, portion.part)}];
      if (known[k]) {
        fit = {true, 1, {{c_.mesh.grid().node_position(c_.mesh.node(node)), 1.0}}};
      } else if (!fit.at_node) {
        add_least_squares(e, portion, k, known, fit);
      }
    }
  }

  /// The nodal value for which N_0 v_0 + N_1 v_1 is nearest to the function on the portion; a
  /// known end keeps its own value.
  void add_least_squares(GridIndex e, const SidePortion& portion, std::size_t which,
                         const bool known[2], Fit& fit) {
    ++fit.contributions;
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    const double length = portion.t1 - portion.t0;
    for (const GaussPoint& g : gauss_points(4)) {
      const double t = portion.t0 + g.x * length;
      const Vec2 n(1 - t, t);
      normal += g.weight * n * n.transpose();
    }
    const std::size_t other = 1 - which;
    Vec2 row(0, 0);  // the value sought is row . (int N_0 g, int N_1 g)
    double from_known = 0.0;
    const auto w = Eigen::Index(which), o = Eigen::Index(other);
    if (known[other]) {
      row[w] = 1.0 / normal(w, w);
      from_known = -normal(w, o) / normal(w, w);
    } else {
      row = normal.inverse().row(w);
    }
    const Vec2 corner(e.i, e.j);
    for (const GaussPoint& g : gauss_points(4)) {
      const double t = portion.t0 + g.x * length;
      fit.samples.push_back(
          {c_.mesh.grid().from_grid(corner + geometry_.at(t)), g.weight * row.dot(Vec2(1 - t, t))});
    }
    if (known[other]) {
      const Vec2 end = corner + geometry_.at(double(other));
      fit.samples.push_back({c_.mesh.grid().from_grid(end), from_known});
    }
  }

  const BasisContext& c_;
  SideGeometry geometry_;
  std::map<std::pair<LocalId, int>, Fit> fits_;
};

}  // namespace

Supports::Supports(const BasisContext& c, const std::vector<BoundarySpec>& blocks) {
  std::map<LocalId, HeldUnknown> held;  // the first block keeps an unknown
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (int component = 0; component < 2; ++component) {
      if (!blocks[b].displacement[std::size_t(component)]) continue;
      if (blocks[b].kind == BoundaryKind::point) {
        const GridIndex nearest = c.mesh.grid().nearest_node(blocks[b].at);
        const LocalId node = c.mesh.find_node(nearest);
        if (node < 0 || !c.mesh.owns(node)) continue;
        for (const int piece : pieces_at_node(c, nearest, pieces_of(c.cuts, nearest))) {
          const LocalId u = c.unknowns.of_piece(node, piece) + component;
          held.try_emplace(
              u, HeldUnknown{u, b, component, {{c.mesh.grid().node_position(nearest), 1.0}}});
        }
      }
      if (blocks[b].kind != BoundaryKind::side) continue;
      const SideFits fits(c, blocks[b].side);
      for (const auto& [key, fit] : fits.fits()) {
        const LocalId u = c.unknowns.of_piece(key.first, key.second) + component;
        HeldUnknown unknown{u, b, component, fit.samples};
        for (Sample& s : unknown.samples) s.weight /= fit.contributions;
        held.try_emplace(u, std::move(unknown));
        // near-tip functions would bend the straight trace between the nodes
        for (const TipUnknowns& tip : c.unknowns.tips(key.first)) {
          // a mode moves both ways at once: it is held whole
          for (LocalId l = tip.has_modes() ? 0 : component; l < tip.count;
               l += tip.has_modes() ? 1 : 2) {
            held.try_emplace(tip.first + l, HeldUnknown{tip.first + l, b, component, {}});
          }
        }
      }
    }
  }
  for (auto& [u, unknown] : held) held_.push_back(std::move(unknown));
}

std::vector<char> Supports::flags(LocalId count) const {
  std::vector<char> flags(std::size_t(count), 0);
  for (const HeldUnknown& h : held_) flags[std::size_t(h.unknown)] = 1;
  return flags;
}

void Supports::prescribe(const std::vector<BoundarySpec>& blocks, double s,
                         std::span<double> u) const {
  for (const HeldUnknown& h : held_) {
    const LoadValue& value = *blocks[h.block].displacement[std::size_t(h.component)];
    double sum = 0.0;
    for (const Sample& sample : h.samples) {
      sum += sample.weight * value.at(sample.at.x(), sample.at.y(), s);
    }
    u[std::size_t(h.unknown)] = sum;
  }
}

}  // namespace cdca
