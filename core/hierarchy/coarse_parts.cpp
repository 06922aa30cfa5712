// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/coarse_parts.hpp"

#include "core/base/sort_once.hpp"
#include "core/cells/quadrature.hpp"
#include "core/mesh/shape_functions.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace cdca {

namespace {

/// Adds B^T D B of the bilinear functions at one point; weight in m2.
void add_point(const Vec2& at, double weight, const Vec2& h, const ElasticMatrix& elastic,
               PlainStiffness& k) {
  const ShapeValues n = shape_functions(at, h);
  Eigen::Matrix<double, 3, 8> b;
  for (Eigen::Index a = 0; a < 4; ++a) {
    const Vec2& g = n.gradient[std::size_t(a)];
    b.middleCols<2>(2 * a) << g.x(), 0, 0, g.y(), g.y(), g.x();
  }
  k += weight * b.transpose() * elastic * b;
}

/// Children counter-clockwise from the lower left, as the corners of an element.
constexpr int child_x[4] = {0, 1, 1, 0}, child_y[4] = {0, 0, 1, 1};

GridIndex child_of(GridIndex e, std::size_t k) {
  return {2 * e.i + child_x[k], 2 * e.j + child_y[k]};
}

std::size_t slot_of(GridIndex child) {
  return child.j % 2 == 0 ? std::size_t(child.i % 2) : std::size_t(3 - child.i % 2);
}

/// The sides between the children: (child, its side, the other, its side).
constexpr std::size_t inner_sides[4][4] = {{0, 1, 1, 3}, {1, 2, 2, 0}, {3, 1, 2, 3}, {0, 2, 3, 0}};
/// The two children along each side of the element, in the direction of growing x or y.
constexpr std::size_t along_side[4][2] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}};

}  // namespace

PlainStiffness child_interpolation(int cx, int cy) {
  PlainStiffness p = PlainStiffness::Zero();
  for (int a = 0; a < 4; ++a) {
    const ShapeValues n =
        shape_functions(Vec2(0.5 * (cx + child_x[a]), 0.5 * (cy + child_y[a])), Vec2(1, 1));
    for (int b = 0; b < 4; ++b) {
      p(2 * a, 2 * b) = p(2 * a + 1, 2 * b + 1) = n.value[std::size_t(b)];
    }
  }
  return p;
}

PlainStiffness FinestParts::stiffness(GridIndex element, int part) const {
  const Vec2& h = grid().element_size();
  PlainStiffness k = PlainStiffness::Zero();
  for (const QuadraturePoint& q : plain_quadrature(cuts_.find(element), part)) {
    add_point(q.at, q.weight * h.prod(), h, elastic_, k);
  }
  return k;
}

CoarseParts::CoarseParts(const ScaleParts& finer, int level, GridIndex body,
                         const ElasticMatrix& elastic)
    : finer_(finer),
      grid_(finer.grid().coarser()),
      stride_(1 << level),
      body_(body),
      elastic_(elastic),
      plain_(plain_stiffness(grid_.element_size(), elastic)) {
  for (const GlobalId id : finer.touched_elements()) {
    const GridIndex child = finer.grid().element_index(id);
    is_touched_.insert(grid_.element({child.i / 2, child.j / 2}));
  }
  touched_.assign(is_touched_.begin(), is_touched_.end());
  std::sort(touched_.begin(), touched_.end());
  join_bonds();
}

void CoarseParts::take_over(CoarseParts& before, const std::vector<GlobalId>& changed) {
  cache_ = std::move(before.cache_);
  for (const GlobalId id : changed) cache_.erase(id);
}

void CoarseParts::join_bonds() {
  std::map<std::array<int, 6>, std::size_t> place;
  for (const Bond& fine : finer_.bonds()) {
    Bond bond{{fine.plus.i / 2, fine.plus.j / 2},
              {fine.minus.i / 2, fine.minus.j / 2},
              part_of(fine.plus, fine.plus_part),
              part_of(fine.minus, fine.minus_part)};
    // where a crack ends inside a coarse element its faces move as one
    if (bond.plus == bond.minus && bond.plus_part == bond.minus_part) continue;
    const auto [at, is_new] =
        place.emplace(std::array<int, 6>{bond.plus.i, bond.plus.j, bond.plus_part, bond.minus.i,
                                         bond.minus.j, bond.minus_part},
                      bonds_.size());
    if (is_new) bonds_.push_back(bond);
    BondStiffness& k = bonds_[at->second].stiffness;
    const PlainStiffness p = child_interpolation(fine.plus.i % 2, fine.plus.j % 2);
    const PlainStiffness m = child_interpolation(fine.minus.i % 2, fine.minus.j % 2);
    k.topLeftCorner<8, 8>() += p.transpose() * fine.stiffness.topLeftCorner<8, 8>() * p;
    k.bottomRightCorner<8, 8>() += m.transpose() * fine.stiffness.bottomRightCorner<8, 8>() * m;
    const PlainStiffness cross = p.transpose() * fine.stiffness.topRightCorner<8, 8>() * m;
    k.topRightCorner<8, 8>() += cross;
    k.bottomLeftCorner<8, 8>() += cross.transpose();
  }
}

bool CoarseParts::touched(GridIndex e) const {
  return grid_.has_element(e) && is_touched_.count(grid_.element(e)) > 0;
}

Vec2 CoarseParts::inside(GridIndex e) const {
  return {std::min(1.0, double(body_.i - e.i * stride_) / stride_),
          std::min(1.0, double(body_.j - e.j * stride_) / stride_)};
}

const std::vector<SidePortion>& CoarseParts::side(GridIndex e, std::size_t side) const {
  static const std::vector<SidePortion> whole{SidePortion{}};
  const Element* element = find(e);
  return element ? element->sides[side] : whole;
}

int CoarseParts::part_of(GridIndex child, int part) const {
  const GridIndex e{child.i / 2, child.j / 2};
  const Element* element = find(e);
  return element ? element->part_of_child[slot_of(child)][std::size_t(part)] : 0;
}

PlainStiffness CoarseParts::stiffness(GridIndex e, int part) const {
  const Element* element = find(e);
  return element ? element->stiffness[std::size_t(part)] : whole(e);
}

PlainStiffness CoarseParts::whole(GridIndex e) const {
  const Vec2 share = inside(e), &h = grid_.element_size();
  if (share.minCoeff() >= 1.0) return plain_;
  PlainStiffness k = PlainStiffness::Zero();
  for (const QuadraturePoint& q : plain_quadrature(nullptr, 0)) {
    add_point(q.at.cwiseProduct(share), q.weight * share.prod() * h.prod(), h, elastic_, k);
  }
  return k;
}

std::vector<PlainStiffness> CoarseParts::whole_elements() const {
  std::vector<PlainStiffness> kinds{plain_};
  const int last_x = grid_.nx() - 1, last_y = grid_.ny() - 1;
  for (const GridIndex e : {GridIndex{last_x, 0}, GridIndex{0, last_y}, GridIndex{last_x, last_y}})
    if (over_the_rim(e)) kinds.push_back(whole(e));
  return kinds;
}

const CoarseParts::Element* CoarseParts::find(GridIndex e) const {
  if (!grid_.has_element(e)) return nullptr;
  const GlobalId id = grid_.element(e);
  const auto it = cache_.find(id);
  if (it != cache_.end()) return &it->second;
  return is_touched_.count(id) > 0 ? &cache_.emplace(id, make_element(e)).first->second : nullptr;
}

CoarseParts::Element CoarseParts::make_element(GridIndex e) const {
  std::array<int, 5> first{};
  for (std::size_t k = 0; k < 4; ++k) {
    const GridIndex child = child_of(e, k);
    first[k + 1] = first[k] + (finer_.grid().has_element(child) ? finer_.parts(child) : 0);
  }
  std::vector<int> root(static_cast<std::size_t>(first[4]));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int k) {
    while (root[std::size_t(k)] != k) k = root[std::size_t(k)];
    return k;
  };
  for (const auto& inner : inner_sides) {
    const GridIndex a = child_of(e, inner[0]), b = child_of(e, inner[2]);
    if (!finer_.grid().has_element(a) || !finer_.grid().has_element(b)) continue;
    for (const SideContact& c : contacts(finer_.side(a, inner[1]), finer_.side(b, inner[3]))) {
      if (!c.open) continue;
      const int k = find(first[inner[0]] + c.first), l = find(first[inner[2]] + c.second);
      root[std::size_t(std::max(k, l))] = std::min(k, l);
    }
  }
  Element made;
  std::vector<int> name(root.size(), -1);
  for (std::size_t k = 0; k < 4; ++k) {
    const PlainStiffness p = child_interpolation(child_x[k], child_y[k]);
    for (int v = first[k]; v < first[k + 1]; ++v) {
      int& part = name[std::size_t(find(v))];
      if (part < 0) {
        part = made.parts++;
        made.stiffness.emplace_back(PlainStiffness::Zero());
      }
      made.part_of_child[k].push_back(part);
      made.stiffness[std::size_t(part)] +=
          p.transpose() * finer_.stiffness(child_of(e, k), v - first[k]) * p;
    }
  }
  make_sides(e, made);
  return made;
}

void CoarseParts::make_sides(GridIndex e, Element& made) const {
  for (std::size_t side = 0; side < 4; ++side) {
    auto& portions = made.sides[side];
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t k = along_side[side][half];
      if (!finer_.grid().has_element(child_of(e, k))) continue;
      for (const SidePortion& p : finer_.side(child_of(e, k), side)) {
        const int part = made.part_of_child[k][std::size_t(p.part)];
        const double t0 = 0.5 * (double(half) + p.t0), t1 = 0.5 * (double(half) + p.t1);
        if (!portions.empty() && portions.back().part == part &&
            portions.back().closed == p.closed) {
          portions.back().t1 = t1;
        } else {
          portions.push_back({t0, t1, part, p.closed});
        }
      }
    }
  }
}

CoarseElements::CoarseElements(const LocalMesh& mesh, const CellUnknowns& unknowns,
                               const CoarseParts& parts)
    : mesh_(mesh),
      unknowns_(unknowns),
      parts_(parts),
      special_(elements_near_cracks(mesh, parts, unknowns)) {
  const StructuredGrid& grid = mesh.grid();
  const auto add = [&](GridIndex e) {
    if (mesh_.find_element(e) >= 0 && parts_.over_the_rim(e)) special_.push_back(grid.element(e));
  };
  for (int i = 0; i < grid.nx(); ++i) add({i, grid.ny() - 1});
  for (int j = 0; j < grid.ny(); ++j) add({grid.nx() - 1, j});
  sort_once(special_);
  for (std::size_t b = 0; b < parts.bonds().size(); ++b) {
    bonds_at_[grid.element(parts.bonds()[b].plus)].push_back(b);
  }
}

std::vector<PartStiffness> CoarseElements::parts(GridIndex element) {
  std::vector<PartStiffness> found;
  const auto nodes = mesh_.element_nodes(element);
  for (int part = 0; part < parts_.parts(element); ++part) {
    PartStiffness own;
    for (std::size_t a = 0; a < 4; ++a) {
      const int piece = unknowns_.piece(nodes[a], (a + 2) % 4, part);
      const LocalId u = unknowns_.of_piece(nodes[a], piece);
      own.unknowns.insert(own.unknowns.end(), {u, u + 1});
    }
    own.matrix = parts_.stiffness(element, part);
    found.push_back(std::move(own));
  }
  return found;
}

std::vector<const PartStiffness*> CoarseElements::faces(GridIndex element) {
  faces_.clear();
  if (const auto at = bonds_at_.find(mesh_.grid().element(element)); at != bonds_at_.end()) {
    for (const std::size_t b : at->second)
      faces_.push_back(held_entries(parts_.bonds()[b], mesh_, unknowns_));
  }
  std::vector<const PartStiffness*> found;
  for (const PartStiffness& face : faces_) found.push_back(&face);
  return found;
}

}  // namespace cdca
