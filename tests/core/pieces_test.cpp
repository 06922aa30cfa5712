// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/pieces.hpp"

#include "core/base/halo.hpp"
#include "core/cells/cell_unknowns.hpp"
#include "core/cracks/crack_registry.hpp"
#include "core/cracks/segments.hpp"
#include "tests/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <random>
#include <string>

namespace cdca {
namespace {

using testing::world;
using Polylines = std::vector<std::vector<Vec2>>;

const StructuredGrid grid(Vec2(0, 0), Vec2(4, 4), 4, 4);

CrackRegistry registry_of(const Polylines& cracks, const StructuredGrid& on = grid) {
  CrackRegistry registry;
  for (const auto& points : cracks) registry.add("", points);
  registry.resolve_initial_meetings({on.origin(), on.origin() + on.size()}, 1e-3);
  return registry;
}

ElementCuts cuts_of(const Polylines& cracks, const StructuredGrid& on = grid) {
  return {on, CrackPaths(on, registry_of(cracks, on).cracks())};
}

struct Support {
  std::string name;
  Polylines cracks;
  GridIndex node;
  int pieces;
};

std::ostream& operator<<(std::ostream& out, const Support& s) { return out << s.name; }

const std::vector<Support> supports{
    {"whole", {}, {2, 2}, 1},
    {"one_crack", {{{0.5, 1.6}, {3.5, 2.3}}}, {2, 2}, 2},
    {"kinked", {{{0.5, 1.6}, {1.7, 2.4}, {2.3, 1.3}, {3.5, 2.3}}}, {2, 2}, 2},
    {"corner_cut_off", {{{0.5, 1.7}, {1.7, 0.5}}}, {2, 2}, 2},
    {"crack_outside", {{{0.2, 0.5}, {0.8, 3.5}}}, {2, 2}, 1},
    {"tip_in_the_support", {{{0.5, 1.6}, {2.3, 2.2}}}, {2, 2}, 1},
    {"tip_behind_the_support", {{{0.5, 1.6}, {3.2, 2.2}}}, {2, 2}, 2},
    {"crack_in_the_support", {{{1.3, 1.4}, {2.7, 2.6}}}, {2, 2}, 1},
    {"touching", {{{0.5, 1.6}, {3.5, 2.4}}, {{1.8, 3.5}, {2, 2}}}, {2, 2}, 3},
    {"crossing", {{{0.5, 1.6}, {3.5, 2.3}}, {{1.9, 0.5}, {2.2, 3.5}}}, {2, 2}, 4},
    {"crossing_elsewhere_in_the_support",
     {{{0.5, 1.4}, {3.5, 1.3}}, {{1.3, 0.5}, {1.2, 3.5}}},
     {2, 2},
     4},
    {"meeting",
     {{{0.5, 1.3}, {2.2, 2.1}}, {{3.5, 1.4}, {2.2, 2.1}}, {{2.4, 3.5}, {2.2, 2.1}}},
     {2, 2},
     3},
    {"two_parallel", {{{0.5, 1.6}, {3.5, 1.6}}, {{0.5, 2.2}, {3.5, 2.2}}}, {2, 2}, 3},
    {"through_the_node", {{{0.5, 0.5}, {3.5, 3.5}}}, {2, 2}, 2},
    {"crossing_in_the_node", {{{0.5, 0.5}, {3.5, 3.5}}, {{0.5, 3.5}, {3.5, 0.5}}}, {2, 2}, 4},
    {"touching_in_the_node", {{{0.5, 0.5}, {3.5, 3.5}}, {{0.5, 3.5}, {2, 2}}}, {2, 2}, 3},
    {"tip_on_the_node", {{{0.5, 0.5}, {2, 2}}}, {2, 2}, 1},
    {"along_a_grid_line", {{{0.5, 2}, {3.5, 2}}}, {2, 2}, 2},
    {"along_both_grid_lines", {{{0.5, 2}, {3.5, 2}}, {{2, 0.5}, {2, 3.5}}}, {2, 2}, 4},
    {"along_grid_lines_round_a_corner", {{{0.5, 2}, {2, 2}, {2, 0.5}}}, {2, 2}, 2},
    {"along_the_line_beside", {{{0.5, 1}, {3.5, 1}}}, {2, 2}, 1},
    {"ends_on_a_grid_line", {{{0.5, 2}, {2.5, 2}}}, {2, 2}, 1},
    {"rim_node", {{{0, 1.6}, {3.5, 2.3}}}, {0, 2}, 2},
    {"corner_node", {{{0, 0.6}, {0.5, 0}}}, {0, 0}, 2},
    {"along_the_rim", {{{0, 0}, {3.5, 0}}}, {2, 0}, 1},
};

class PiecesTest : public ::testing::TestWithParam<Support> {};

TEST_P(PiecesTest, AreCountedInEveryPosition) {
  for (int position = 0; position < 8; ++position) {
    Polylines cracks = GetParam().cracks;
    Vec2 at(GetParam().node.i, GetParam().node.j);
    const auto turn = [position](Vec2& p) {
      if (position & 1) p.x() = 4 - p.x();
      if (position & 2) p.y() = 4 - p.y();
      if (position & 4) std::swap(p.x(), p.y());
    };
    for (auto& points : cracks)
      for (Vec2& p : points) turn(p);
    turn(at);
    const CellPieces found = pieces_of(cuts_of(cracks), {int(at.x()), int(at.y())});
    EXPECT_EQ(found.count, GetParam().pieces) << "position " << position;
  }
}

TEST_P(PiecesTest, AreNumberedWithoutGaps) {
  const ElementCuts cuts = cuts_of(GetParam().cracks);
  const CellPieces found = pieces_of(cuts, GetParam().node);
  const auto elements = grid.elements_round(GetParam().node);
  std::vector<int> seen(std::size_t(found.count), 0);
  for (std::size_t slot = 0; slot < 4; ++slot) {
    const bool exists = grid.has_element(elements[slot]);
    EXPECT_EQ(int(found.piece[slot].size()), exists ? cuts.parts(elements[slot]) : 0);
    for (const int piece : found.piece[slot]) ++seen.at(std::size_t(piece));
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 0), 0);
}

INSTANTIATE_TEST_SUITE_P(Supports, PiecesTest, ::testing::ValuesIn(supports),
                         [](const auto& test) { return test.param.name; });

/// Sizes of the connected parts of [1, 3]^2, as numbers of places on a lattice: neighbours are
/// connected when no crack lies between them.
std::vector<int> lattice_parts(const Polylines& cracks, int n) {
  std::vector<int> root(std::size_t(n * n));
  for (std::size_t k = 0; k < root.size(); ++k) root[k] = int(k);
  const auto find = [&root](int k) {
    while (root[std::size_t(k)] != k)
      k = root[std::size_t(k)] = root[std::size_t(root[std::size_t(k)])];
    return k;
  };
  const auto place = [n](int i, int j) {
    return Vec2(1 + 2 * (i + 0.5) / n, 1 + 2 * (j + 0.5) / n);
  };
  const auto join = [&](int i, int j, int k, int l) {
    for (const auto& points : cracks)
      for (std::size_t s = 0; s + 1 < points.size(); ++s)
        if (crossing_of(place(i, j), place(k, l), points[s], points[s + 1])) return;
    root[std::size_t(find(j * n + i))] = find(l * n + k);
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if (i + 1 < n) join(i, j, i + 1, j);
      if (j + 1 < n) join(i, j, i, j + 1);
    }
  std::map<int, int> sizes;
  for (int k = 0; k < n * n; ++k) ++sizes[find(k)];
  std::vector<int> found;
  for (const auto& [name, size] : sizes) found.push_back(size);
  return found;
}

TEST(PiecesOfRandomCracks, AreThePartsThatALatticeFinds) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> any(0.2, 3.8);
  constexpr int n = 60;
  int compared = 0, separated = 0;
  for (int k = 0; k < 200; ++k) {
    Polylines cracks(1 + std::size_t(k % 3));
    for (auto& points : cracks)
      for (int s = 0; s < 2 + k % 2; ++s) points.emplace_back(any(random), any(random));
    const auto parts = lattice_parts(cracks, n);
    if (*std::min_element(parts.begin(), parts.end()) < n * n / 50) continue;  // too thin to see
    ++compared;
    separated += parts.size() > 1;
    EXPECT_EQ(pieces_of(cuts_of(cracks), {2, 2}).count, int(parts.size())) << "case " << k;
  }
  EXPECT_GT(compared, 80);
  EXPECT_GT(separated, 40);
}

/// Cracks for the rank borders of a grid of 8 x 8: cut, kinked, T, X, Y and tips.
const Polylines network{{{0, 2.3}, {3.1, 2.6}, {3.4, 4.6}, {6.3, 4.2}},
                        {{2.2, 0.4}, {2.6, 5.5}},
                        {{4.6, 6.8}, {4.7, 4.42}},
                        {{5.5, 0.6}, {5.5, 3}, {7, 3}},
                        {{1.2, 6.2}, {3.3, 7.1}},
                        {{1.2, 6.2}, {0.3, 7.4}},
                        {{1.2, 6.2}, {1.4, 5.1}}};

struct Owners {
  const char* name;
  int block;
  int (*owner)(int i, int j, int ranks);
};

class PiecesParallel : public ::testing::TestWithParam<Owners> {
 protected:
  PiecesParallel() : registry_(registry_of(network, wide_)), cuts_(cuts_of(network, wide_)) {
    const int block = GetParam().block, blocks = (9 + block - 1) / block;
    std::vector<int> owners;
    for (int j = 0; j < blocks; ++j)
      for (int i = 0; i < blocks; ++i) owners.push_back(GetParam().owner(i, j, world().size()));
    mesh_ = LocalMesh(wide_, BlockPartition(wide_, block, owners), world().rank());
    zones_ = find_tip_zones(cuts_, registry_.cracks(), {1.3, 2.0});
    unknowns_ = CellUnknowns(mesh_, cuts_, zones_, world());
  }
  const StructuredGrid wide_{Vec2(0, 0), Vec2(8, 8), 8, 8};
  CrackRegistry registry_;
  ElementCuts cuts_;
  LocalMesh mesh_;
  std::vector<TipZone> zones_;
  CellUnknowns unknowns_;
};

TEST_P(PiecesParallel, GhostsHaveThePiecesOfTheirOwners) {
  std::int64_t special = 0, with_modes = 0;
  for (LocalId n = 0; n < mesh_.node_count(); ++n) {
    const CellPieces whole = pieces_of(cuts_, mesh_.node(n));  // sees all cracks, on any rank
    std::vector<int> tips;
    for (std::size_t z = 0; z < zones_.size(); ++z)
      if (zones_[z].nodes.count(mesh_.node_id(n))) tips.push_back(int(z));
    const SpecialCell* cell = unknowns_.special(n);
    EXPECT_EQ(unknowns_.pieces(n), whole.count) << "node " << mesh_.node_id(n);
    EXPECT_EQ(cell != nullptr, whole.count > 1 || !tips.empty()) << "node " << mesh_.node_id(n);
    if (!cell) continue;
    EXPECT_EQ(*cell->pieces, whole) << "node " << mesh_.node_id(n);
    std::vector<int> zones;
    for (const TipUnknowns& tip : cell->tips) {
      zones.push_back(tip.zone);
      EXPECT_EQ(tip.has_modes(),
                zones_[std::size_t(tip.zone)].with_modes.count(mesh_.node_id(n)) == 1);
      with_modes += tip.has_modes();
    }
    EXPECT_EQ(zones, tips) << "node " << mesh_.node_id(n);
    special += mesh_.owns(n);
  }
  EXPECT_GT(world().sum(special), 30);
  EXPECT_GT(world().sum(with_modes), 10);
}

TEST_P(PiecesParallel, UnknownsAreNumberedOnceOwnOnesFirst) {
  std::vector<int> seen(std::size_t(unknowns_.count()), 0);
  for (LocalId n = 0; n < mesh_.node_count(); ++n)
    for (const LocalId u : unknowns_.of_cell(n)) {
      ++seen.at(std::size_t(u));
      EXPECT_EQ(u < unknowns_.owned(), mesh_.owns(n));
    }
  EXPECT_EQ(seen, std::vector<int>(seen.size(), 1));
}

TEST_P(PiecesParallel, RanksHoldAllUnknownsTogether) {
  std::int64_t expected = 0;
  for (GlobalId id = 0; id < wide_.node_count(); ++id) {
    expected += 2 * pieces_of(cuts_, wide_.node_index(id)).count;
    for (const TipZone& zone : zones_)
      expected +=
          8 * std::int64_t(zone.nodes.count(id)) - 6 * std::int64_t(zone.with_modes.count(id));
  }
  EXPECT_EQ(world().sum(std::int64_t(unknowns_.owned())), expected);
}

TEST_P(PiecesParallel, SharedUnknownsMeetTheirOwn) {
  // each unknown carries its cell and its place in it
  const auto fill = [&](std::vector<double>& values, LocalId n) {
    double place = 0.0;
    for (const LocalId u : unknowns_.of_cell(n))
      values[std::size_t(u)] = 1000.0 * double(mesh_.node_id(n)) + place++;
  };
  std::vector<double> values(std::size_t(unknowns_.count()), -1.0), expected = values;
  for (LocalId n = 0; n < mesh_.node_count(); ++n) {
    fill(expected, n);
    if (mesh_.owns(n)) fill(values, n);
  }
  Halo(world(), unknowns_.shared(mesh_)).copy_state(values);
  EXPECT_EQ(values, expected);
}

INSTANTIATE_TEST_SUITE_P(
    Partitions, PiecesParallel,
    ::testing::Values(
        Owners{"checkerboard", 1,
               [](int i, int j, int ranks) { return (2 * (j % 2) + i % 2) % ranks; }},
        Owners{"stripes", 1, [](int i, int, int ranks) { return i % ranks; }},
        Owners{"blocks", 3, [](int i, int j, int ranks) { return (i + j) % ranks; }},
        Owners{"scattered", 1, [](int i, int j, int ranks) { return (7 * i + 3 * j) / 4 % ranks; }},
        Owners{"nothing_on_rank_zero", 2,
               [](int i, int j, int ranks) { return ranks == 1 ? 0 : 1 + (i + j) % (ranks - 1); }}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace cdca
