// SPDX-License-Identifier: BSD-3-Clause
/// How many iterations the multilevel solver takes to 1e-8, whatever the cracks, the grid and the
/// loads. The bars are those of docs/solver.md. Slow suites print what they measure.
#include "tests/cracked_plates.hpp"

#include <gtest/gtest.h>

#include <iostream>

namespace cdca::testing {
namespace {

constexpr Pull both_ways[] = {Pull::by_displacement, Pull::by_traction};

const char* name_of(Pull how) { return how == Pull::by_displacement ? "moved" : "pulled"; }

int iterations(const CaseSpec& spec) { return solved(spec).equilibrium.solver.iterations; }

void report(const std::string& name, Pull how, int count) {
  std::cout << "iterations, " << name << ", " << name_of(how) << ": " << count << std::endl;
}

/// As many scales as there can be: the coarsest has 60 cells at most.
CaseSpec with_all_scales(CaseSpec spec) {
  spec.solver.coarsest_nodes = 60;
  return spec;
}

// --- grids of all sizes, materials ---------------------------------------------------------------

struct Size {
  int nx, ny;
};

void expect_odd_grids(const std::vector<Size>& sizes) {
  for (const Size n : sizes) {
    for (const Pull how : both_ways) {
      const CaseSpec spec = plate_of(n.nx, n.ny, three_cracks(), how);
      EXPECT_LE(iterations(spec), 28) << n.nx << " x " << n.ny << " " << name_of(how);
      EXPECT_LE(iterations(with_all_scales(spec)), 40)
          << n.nx << " x " << n.ny << " " << name_of(how);
    }
  }
}

TEST(MultilevelIterations, OddGrids) { expect_odd_grids({{61, 127}, {37, 73}, {53, 101}}); }
TEST(SlowMultilevelIterations, OddGrids) {
  expect_odd_grids({{91, 181}, {101, 201}, {97, 193}, {129, 257}, {127, 255}, {211, 431}});
}

TEST(MultilevelIterations, PlaneStressAndPoisson) {
  struct Row {
    bool strain;
    double poisson;
    int most;
  };
  // plane strain locks as nu comes near 0.5: docs/solver.md
  for (const Row row : {Row{true, 0.0, 28},
                        {true, 0.4, 40},
                        {true, 0.45, 40},
                        {true, 0.49, 90},
                        {false, 0.0, 28},
                        {false, 0.3, 28},
                        {false, 0.49, 28}}) {
    for (const Pull how : both_ways) {
      CaseSpec spec = plate_of(31, 61, three_cracks(), how);
      spec.solver.coarsest_nodes = 600;
      spec.domain.plane_strain = row.strain;
      spec.material.poisson = row.poisson;
      EXPECT_LE(iterations(spec), row.most) << row.strain << " " << row.poisson << name_of(how);
    }
  }
}

TEST(MultilevelIterations, OblongCells) {
  struct Row {
    int nx, ny, most;
  };
  // 1:1.5, 1:2, 1:4 and 4:1
  for (const Row row : {Row{60, 180, 28}, {60, 240, 40}, {40, 320, 80}, {160, 80, 80}}) {
    for (const Pull how : both_ways)
      EXPECT_LE(iterations(plate_of(row.nx, row.ny, three_cracks(), how)), row.most)
          << row.nx << " x " << row.ny << " " << name_of(how);
  }
}

// --- cracks of all kinds -------------------------------------------------------------------------

struct Layout {
  const char* name;
  Cracks cracks;
};

void PrintTo(const Layout& layout, std::ostream* out) { *out << layout.name; }

/// On 32 x 64 elements: lines and nodes are multiples of 1 / 32.
std::vector<Layout> layouts() {
  return {
      {"none", {}},
      {"edge", {{{0, 0.97}, {0.62, 1.02}}}},
      {"edges_that_nearly_meet", {{{0, 0.97}, {0.47, 0.98}}, {{1, 0.96}, {0.53, 1}}}},
      {"almost_through", {{{0, 0.97}, {0.94, 1.02}}}},
      {"kinked", {{{0.2, 0.6}, {0.42, 0.63}, {0.44, 0.9}, {0.7, 0.8}, {0.72, 1.3}}}},
      {"zigzag_within_elements",
       {{{0.2, 1}, {0.3, 1.01}, {0.31, 0.99}, {0.32, 1.01}, {0.33, 0.99}, {0.7, 1.013}}}},
      {"tee", {{{0.2, 1}, {0.81, 1.03}}, {{0.5, 1.4}, {0.5, 1.01475}}}},
      {"star", {{{0.5, 1}, {0.81, 1.13}}, {{0.5, 1}, {0.3, 1.21}}, {{0.5, 1}, {0.42, 0.6}}}},
      {"cross", {{{0.2, 0.7}, {0.81, 1.33}}, {{0.25, 1.3}, {0.72, 0.72}}}},
      {"triple_cross", {{{0.2, 0.7}, {0.8, 1.3}}, {{0.2, 1.3}, {0.8, 0.7}}, {{0.1, 1}, {0.9, 1}}}},
      {"along_grid_lines", {{{0.25, 1}, {0.75, 1}}, {{0.5, 0.25}, {0.5, 0.75}}}},
      {"between_grid_lines", {{{0.25, 1.015625}, {0.75, 1.015625}}}},
      {"through_nodes", {{{0.25, 0.75}, {0.75, 1.25}}, {{0.3125, 0.25}, {0.71875, 0.65625}}}},
      {"grazing_nodes", {{{0.25, 1.00001}, {0.75, 1.00001}}, {{0.2, 0.5}, {0.8, 0.50002}}}},
      {"close_and_parallel",
       {{{0.2, 1.01}, {0.8, 1.01}}, {{0.2, 1.025}, {0.8, 1.025}}, {{0.25, 1.04}, {0.7, 1.04}}}},
      {"tip_to_tip", {{{0.2, 1.01}, {0.49, 1.01}}, {{0.51, 1.01}, {0.8, 1.01}}}},
      {"along_the_rim", {{{0.03, 0.5}, {0.03, 1.5}}, {{0.2, 1.97}, {0.8, 1.97}}}},
      {"comb",
       {{{0, 1}, {0.9, 1}},
        {{0.2, 1}, {0.2, 1.8}},
        {{0.4, 1}, {0.4, 1.8}},
        {{0.6, 1}, {0.6, 1.8}}}},
      {"ladder",
       {{{0, 0.5}, {0.93, 0.5}},
        {{1, 0.8}, {0.07, 0.8}},
        {{0, 1.1}, {0.93, 1.1}},
        {{1, 1.4}, {0.07, 1.4}}}},
      {"spiral",
       {{{0.1, 0.5},
         {0.9, 0.5},
         {0.9, 1.5},
         {0.2, 1.5},
         {0.2, 0.7},
         {0.75, 0.7},
         {0.75, 1.3},
         {0.35, 1.3},
         {0.35, 0.85},
         {0.6, 0.85}}}},
  };
}

class MultilevelLayouts : public ::testing::TestWithParam<Layout> {};

TEST_P(MultilevelLayouts, AtMostForty) {
  for (const Pull how : both_ways) {
    for (const Size n : {Size{32, 64}, {37, 71}}) {
      const CaseSpec spec = plate_of(n.nx, n.ny, GetParam().cracks, how);
      EXPECT_LE(iterations(with_all_scales(spec)), 40)
          << n.nx << " x " << n.ny << " " << name_of(how);
    }
  }
}

TEST_P(MultilevelLayouts, FieldsOfKrylov) {
  CaseSpec spec = with_all_scales(plate_of(32, 64, GetParam().cracks));
  spec.solver.tolerance = 1e-11;
  const Solved multilevel = solved(spec);
  spec.solver.method = SolverMethod::krylov;
  const Solved krylov = solved(spec);
  double largest = 0.0, farthest = 0.0;
  for (std::size_t u = 0; u < krylov.model->state().size(); ++u) {
    largest = std::max(largest, std::abs(krylov.model->state()[u]));
    farthest =
        std::max(farthest, std::abs(krylov.model->state()[u] - multilevel.model->state()[u]));
  }
  EXPECT_LT(farthest, 1e-7 * largest);
}

INSTANTIATE_TEST_SUITE_P(Cracks, MultilevelLayouts, ::testing::ValuesIn(layouts()),
                         [](const auto& layout) { return std::string(layout.param.name); });

// --- networks ------------------------------------------------------------------------------------

/// Twenty long cracks that cross at will and cut off fragments, which weak springs hold.
void expect_networks(unsigned last, Size n, std::vector<Pull> ways) {
  int most = 0, fragments = 0;
  for (unsigned seed = 1; seed <= last; ++seed) {
    for (const Pull how : ways) {
      const Solved s =
          solved_as_grown(with_all_scales(plate_of(n.nx, n.ny, network(20, 0.5, seed), how)));
      EXPECT_LE(s.equilibrium.solver.iterations, 40) << "seed " << seed << " " << name_of(how);
      most = std::max(most, s.equilibrium.solver.iterations);
      for (const Body& body : s.model->bodies().list()) fragments += !body.held;
    }
  }
  EXPECT_GT(fragments, 0);
  std::cout << "iterations, networks on " << n.nx << " x " << n.ny << ": at most " << most
            << std::endl;
}

TEST(MultilevelNetworks, TwentySeeds) { expect_networks(20, {30, 61}, {Pull::by_traction}); }
TEST(SlowMultilevelNetworks, FortySeeds) {
  expect_networks(40, {80, 160}, {Pull::by_displacement, Pull::by_traction});
}

TEST(MultilevelNetworks, FragmentsOfAllKinds) {
  const std::vector<Layout> cuts = {
      {"across", {{{0, 0.9}, {1, 1.1}}}},
      {"corner", {{{0.7, 2}, {1, 1.6}}}},
      {"pinned_corner", {{{0, 0.2}, {0.2, 0}}}},
      {"chip_of_the_rim", {{{0.35, 2}, {0.5, 1.7}}, {{0.5, 1.7}, {0.65, 2}}}},
      {"island", {{{0.3, 1}, {0.7, 1}}, {{0.7, 1}, {0.5, 1.3}}, {{0.5, 1.3}, {0.3, 1}}}},
      {"island_of_one_element",
       {{{0.31, 1}, {0.34, 1}}, {{0.34, 1}, {0.33, 1.04}}, {{0.33, 1.04}, {0.31, 1}}}},
  };
  for (const Layout& cut : cuts) {
    for (const Pull how : both_ways) {
      const Solved s = solved_as_grown(with_all_scales(plate_of(40, 80, cut.cracks, how)));
      EXPECT_GT(s.model->bodies().list().size(), 1u) << cut.name;
      EXPECT_LE(s.equilibrium.solver.iterations, 40) << cut.name << " " << name_of(how);
    }
  }
}

// --- supports at points
// ---------------------------------------------------------------------------

/// As many steps as with sides that are held, and hardly more on finer grids: a plate on three
/// points, in the corners and where no coarse cell is.
TEST(MultilevelIterations, SupportsAtPoints) {
  const std::vector<std::vector<Vec2>> places = {{{0, 0}, {1, 0}},
                                                 {{0.325, 0.475}, {0.775, 1.625}}};
  for (const auto& at : places) {
    int first = 0;
    for (const int nx : {40, 80, 160}) {
      CaseSpec spec = with_all_scales(plate_of(nx, 2 * nx, three_cracks(), Pull::by_traction));
      spec.boundaries.resize(4);  // the tractions
      for (const Vec2& x : at) {
        BoundarySpec b = at_point(x);
        b.displacement[1] = proportional_load(0);
        if (x == at[0]) b.displacement[0] = proportional_load(0);
        spec.boundaries.push_back(b);
      }
      const int count = iterations(spec);
      if (first == 0) first = count;
      EXPECT_LE(count, 28) << nx;
      EXPECT_LE(count, first + 3) << nx;
    }
  }
}

// --- wide zones ----------------------------------------------------------------------------------

TEST(MultilevelIterations, WideTipZones) {
  for (const double elements : {3.0, 9.5}) {
    CaseSpec spec = plate_of(61, 127, three_cracks(), Pull::by_traction);
    spec.tip_radius = elements / 61;
    EXPECT_LE(iterations(spec), 28) << elements;
    EXPECT_LE(iterations(with_all_scales(spec)), 40) << elements;
  }
}

TEST(SlowMultilevelIterations, TipRadiusOf31Elements) {
  for (const Pull how : both_ways) {
    CaseSpec spec = plate_of(320, 640, one_crack(), how);
    spec.tip_radius = 31.0 / 320;
    const int usual = iterations(spec), all = iterations(with_all_scales(spec));
    report("tip radius 31 elements, 320 x 640", how, usual);
    report("tip radius 31 elements, 320 x 640, all scales", how, all);
    EXPECT_LE(usual, 40);
    EXPECT_LE(all, 40);
  }
}

// --- refinement ----------------------------------------------------------------------------------

/// Elements halved three times.
void expect_refinement(const std::string& name, const Cracks& cracks, int most) {
  for (const Pull how : both_ways) {
    int first = 0;
    for (const int nx : {80, 160, 320, 640}) {
      const SolverReport solve = solved(plate_of(nx, 2 * nx, cracks, how)).equilibrium.solver;
      report(name + ", " + std::to_string(nx) + " x " + std::to_string(2 * nx), how,
             solve.iterations);
      EXPECT_LE(solve.iterations, most) << nx;
      if (first == 0) first = solve.iterations;
      // a nearly severed plate opens by five widths: on the finest grid rounding ends the solve
      if (solve.residual <= 1e-8) {
        EXPECT_LE(solve.iterations, first + 4) << nx;
      }
    }
  }
}

TEST(SlowMultilevelRefinement, OneCrack) { expect_refinement("1 crack", one_crack(), 28); }
TEST(SlowMultilevelRefinement, ThreeCracks) { expect_refinement("3 cracks", three_cracks(), 28); }
TEST(SlowMultilevelRefinement, FiftyCracks) { expect_refinement("50 cracks", fifty_cracks(), 28); }
TEST(SlowMultilevelRefinement, Crossing) { expect_refinement("crossing", crossing(), 40); }
TEST(SlowMultilevelRefinement, NearlySevering) {
  expect_refinement("nearly severing", nearly_severing(), 40);
}

/// Reported: plane strain near nu = 0.5 and cells four times as long as wide take more.
TEST(SlowMultilevelRefinement, HardMaterialAndCells) {
  for (const int nx : {40, 80, 160}) {
    for (const Pull how : both_ways) {
      CaseSpec soft = plate_of(nx, 2 * nx, three_cracks(), how);
      soft.material.poisson = 0.49;
      const std::string size = ", " + std::to_string(nx) + " elements across";
      report("nu 0.49" + size, how, iterations(soft));
      report("cells 1:4" + size, how, iterations(plate_of(nx, 8 * nx, three_cracks(), how)));
      report("cells 4:1" + size, how, iterations(plate_of(nx, nx / 2, three_cracks(), how)));
    }
  }
}

}  // namespace
}  // namespace cdca::testing
