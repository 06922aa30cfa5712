// SPDX-License-Identifier: BSD-3-Clause
// What a case file means: values, defaults, names, settings of the command line.
#include "io/case_describe.hpp"
#include "tests/io/case_samples.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace cdca {
namespace {

using testing::changed;
using testing::plate;
using testing::problems_of;

CaseSpec read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    return read_case_text(text, "cases/plate.toml", overrides);
  } catch (const InputError& error) {
    ADD_FAILURE() << testing::text_of(error.problems());
    throw;
  }
}

TEST(CaseFile, GivesTheValuesOfTheFile) {
  const auto spec = read(plate);
  EXPECT_EQ(spec.file, "cases/plate.toml");
  EXPECT_EQ(spec.title, "Plate");
  EXPECT_EQ(spec.domain.size, Vec2(2.0, 4.0));
  EXPECT_EQ(spec.domain.cells, (std::array{20, 40}));
  EXPECT_EQ(spec.material.young, 1e9);
  EXPECT_EQ(spec.material.poisson, 0.3);
  EXPECT_EQ(spec.load_factors, (std::vector{0.25, 0.5, 0.75, 1.0}));
  EXPECT_EQ(spec.solver.tolerance, 1e-9);
  EXPECT_EQ(spec.output.every, 2);
  ASSERT_EQ(spec.cracks.size(), 2u);
  EXPECT_EQ(spec.cracks[0].name, "edge");
  EXPECT_EQ(spec.cracks[0].line, testing::line_of(plate, "[[crack]]"));
  ASSERT_EQ(spec.cracks[0].points.size(), 2u);
  EXPECT_EQ(spec.cracks[0].points[1], Vec2(0.95, 2.0));
}

TEST(CaseFile, FillsInTheDefaults) {
  const auto spec = read(plate);
  EXPECT_EQ(spec.domain.origin, Vec2(0.0, 0.0));
  EXPECT_EQ(spec.domain.thickness, 1.0);
  EXPECT_FALSE(spec.domain.plane_strain);
  EXPECT_FALSE(spec.domain.body_force[0] || spec.domain.body_force[1]);
  EXPECT_FALSE(spec.material.tensile_strength || spec.material.toughness);
  EXPECT_EQ(spec.tip_radius, 0.0);
  EXPECT_EQ(spec.solver.method, SolverMethod::multilevel);
  EXPECT_EQ(spec.solver.over_relaxation, 1.0);
  EXPECT_EQ(spec.solver.max_iterations, 0);
  EXPECT_TRUE(spec.output.pictures);
  EXPECT_EQ(read(changed(plate, "steps = 4", "")).load_factors, std::vector{1.0});
  EXPECT_EQ(read(changed(plate, "title = \"Plate\"", "")).title, "plate");
}

TEST(CaseFile, HasTheSameDefaultsAsTheSimulation) {
  const auto text = changed(changed(plate, "tolerance = 1e-9", ""), "every = 2", "");
  const auto spec = read(changed(text, "steps = 4", ""));
  const CaseSpec plain;
  EXPECT_EQ(spec.solver.method, plain.solver.method);
  EXPECT_EQ(spec.solver.tolerance, plain.solver.tolerance);
  EXPECT_EQ(spec.solver.over_relaxation, plain.solver.over_relaxation);
  EXPECT_EQ(spec.solver.max_iterations, plain.solver.max_iterations);
  EXPECT_EQ(spec.output.every, plain.output.every);
  EXPECT_EQ(spec.output.pictures, plain.output.pictures);
  EXPECT_EQ(spec.load_factors, plain.load_factors);
  EXPECT_EQ(spec.tip_radius, plain.tip_radius);
  EXPECT_EQ(spec.domain.thickness, plain.domain.thickness);
  EXPECT_EQ(spec.domain.plane_strain, plain.domain.plane_strain);
}

TEST(CaseFile, TurnsCenterLengthAndAngleIntoPoints) {
  const auto crack = read(plate).cracks[1];
  EXPECT_EQ(crack.name, "crack2");
  ASSERT_EQ(crack.points.size(), 2u);
  const double c = std::sqrt(3.0) / 2.0;
  EXPECT_NEAR((crack.points[0] - Vec2(1.5 - 0.2 * c, 2.9)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((crack.points[1] - Vec2(1.5 + 0.2 * c, 3.1)).norm(), 0.0, 1e-14);
}

TEST(CaseFile, ReadsSupportsAndLoads) {
  const auto blocks = read(plate).boundaries;
  ASSERT_EQ(blocks.size(), 3u);
  EXPECT_EQ(blocks[0].kind, BoundaryKind::side);
  EXPECT_EQ(blocks[0].side, Side::bottom);
  EXPECT_EQ(blocks[0].name, "bottom");
  EXPECT_FALSE(blocks[0].displacement[0]);
  ASSERT_TRUE(blocks[0].displacement[1]);
  EXPECT_EQ(blocks[0].displacement[1]->at(1.0, 0.0, 1.0), 0.0);
  EXPECT_EQ(blocks[1].kind, BoundaryKind::point);
  EXPECT_EQ(blocks[1].name, "at_1");
  EXPECT_EQ(blocks[1].at, Vec2(0.0, 0.0));
  EXPECT_FALSE(blocks[2].traction[0]);  // zero
  ASSERT_TRUE(blocks[2].traction[1]);
  EXPECT_EQ(blocks[2].traction[1]->at(0.3, 4.0, 0.5), 0.5e6);
  EXPECT_TRUE(blocks[2].traction[1]->proportional);
}

TEST(CaseFile, ReadsForcesPressureAndBodyForce) {
  auto text = changed(plate, "on = \"top\"\ntraction = [0.0, 1e6]",
                      "at = [1.0, 4.0]\nforce = [\"2e3*s\", 0]\n[[boundary]]\non = "
                      "\"crack:edge\"\npressure = \"1e6*x\"");
  text = changed(text, "cells = [20, 40]",
                 "cells = [20, 40]\nbody_force = [0.0, -2.6e4]\nplane = \"strain\"");
  const auto spec = read(text);
  EXPECT_TRUE(spec.domain.plane_strain);
  ASSERT_TRUE(spec.domain.body_force[1]);
  EXPECT_EQ(spec.domain.body_force[1]->at(0.0, 0.0, 0.5), -1.3e4);
  EXPECT_EQ(spec.boundaries[2].force[0]->at(0.0, 0.0, 0.5), 1e3);
  EXPECT_FALSE(spec.boundaries[2].force[1]);
  EXPECT_EQ(spec.boundaries[3].kind, BoundaryKind::crack);
  EXPECT_EQ(spec.boundaries[3].name, "crack:edge");
  EXPECT_EQ(spec.boundaries[3].crack, "edge");
  EXPECT_EQ(spec.boundaries[3].pressure->at(0.5, 2.0, 0.1), 0.5e6);
  EXPECT_FALSE(spec.boundaries[3].pressure->proportional);
}

TEST(CaseFile, GivesEveryBlockItsOwnName) {
  const auto spec = read(changed(plate, "[[boundary]]\nat",
                                 "[[boundary]]\non = \"top\"\ntraction = [1.0, 0]\n"
                                 "[[boundary]]\nat = [2, 0]\nforce = [0, 1]\n[[boundary]]\nat"));
  std::vector<std::string> names;
  for (const auto& block : spec.boundaries) names.push_back(block.name);
  EXPECT_EQ(names, (std::vector<std::string>{"bottom", "top", "at_1", "at_2", "top_2"}));
}

TEST(CaseFile, TakesValuesThatLaterVersionsWillRead) {
  const auto text = changed(plate, "[solver]",
                            "[contact]\nlaw = \"none\"\n[growth]\ncriterion = \"none\"\n[solver]");
  EXPECT_TRUE(problems_of(changed(text, "every = 2", "checkpoint_every = 0")).empty());
  EXPECT_TRUE(problems_of(changed(text, "steps = 4", "mode = \"prescribed\"")).empty());
}

TEST(CaseFileOverrides, WinOverTheFile) {
  const auto spec =
      read(plate, {"material.young=2e9", "boundary[2].traction=[0, \"1e6*x*s\"]",
                   "crack.0.points=[[0.0, 1.0], [0.5, 1.0]]", "domain.size[1] = 5.0",
                   "solver.method=relaxation", "title=Two words", "material.young=3e9"});
  EXPECT_EQ(spec.material.young, 3e9);
  EXPECT_EQ(spec.boundaries[2].traction[1]->at(0.5, 0.0, 1.0), 0.5e6);
  EXPECT_EQ(spec.cracks[0].points[1], Vec2(0.5, 1.0));
  EXPECT_EQ(spec.domain.size, Vec2(2.0, 5.0));
  EXPECT_EQ(spec.solver.method, SolverMethod::relaxation);
  EXPECT_EQ(spec.title, "Two words");
}

TEST(CaseFileOverrides, ReplaceKeysThatWouldContradictThem) {
  EXPECT_EQ(read(plate, {"loading.factors=[0.5, 2]"}).load_factors, (std::vector{0.5, 2.0}));
  const auto spec =
      read(plate, {"crack[0].center=[0.5, 1]", "crack[0].length=0.5", "crack[0].angle=0",
                   "crack[1].points=[[1, 3], [1.5, 3]]", "boundary[1].on=left"});
  EXPECT_NEAR(spec.cracks[0].points[1].x(), 0.75, 1e-15);
  EXPECT_EQ(spec.cracks[1].points[1], Vec2(1.5, 3.0));
  EXPECT_EQ(spec.boundaries[1].name, "left");
  const auto problems = problems_of(plate, {"loading.factors=[0.5, 2]", "loading.steps=3"});
  ASSERT_EQ(problems.size(), 1u) << testing::text_of(problems);
  EXPECT_NE(problems[0].message.find("contradict"), std::string::npos);
}

TEST(CaseFileOverrides, MakeTablesThatTheFileHasNot) {
  EXPECT_EQ(read(plate, {"enrichment.tip_radius=0.3"}).tip_radius, 0.3);
}

TEST(CaseFileOverrides, NameTheCommandLineInMessages) {
  const auto problems = problems_of(plate, {"material.poisson=0.7", "crack[0].points[1][0]=9"});
  ASSERT_EQ(problems.size(), 2u) << testing::text_of(problems);
  for (const auto& problem : problems) {
    EXPECT_TRUE(problem.message.ends_with(" (this was set on the command line)."))
        << problem.message;
  }
  EXPECT_EQ(problems[0].key, "material.poisson");
  EXPECT_EQ(problems[0].line, 0);
}

TEST(CaseFileOverrides, ThatCannotBeApplied) {
  const auto message = [](const std::string& setting) {
    const auto problems = problems_of(plate, {setting});
    return problems.size() == 1 ? problems[0].message : testing::text_of(problems);
  };
  for (const auto* setting :
       {"young", "=3", "material..young=3", "crack[0=3", "crack[0]x=3", ".a=1"}) {
    EXPECT_NE(message(setting).find("allowed is key.path=value"), std::string::npos)
        << message(setting);
  }
  EXPECT_NE(message("crack[2].name=a").find("sets entry 2, but the case file has 2"),
            std::string::npos);
  EXPECT_NE(message("crack.edge.name=a").find("the number of an entry is needed"),
            std::string::npos);
  EXPECT_NE(message("title.x=1").find("inside of the text \"Plate\""), std::string::npos);
  EXPECT_NE(message("material.yung=1").find("did you mean \"young\"?"), std::string::npos);
  EXPECT_NE(message("domain.size=[1, 2").find("Found the text \"[1, 2\""), std::string::npos);
}

TEST(CaseFileOverrides, CannotSmuggleInOtherKeys) {
  const auto problems = problems_of(plate, {"material.young=1\npoisson=0.1"});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "material.young");
}

TEST(CaseFileRanks, ReadTheSameFile) {
  SerialCommunicator ranks;
  const auto path = std::string(CDCA_SOURCE_DIR) + "/examples/edge_crack.toml";
  EXPECT_EQ(read_case(path, {}, ranks).effective, read_case(path).effective);
  EXPECT_THROW(read_case("/no/such/case.toml", {}, ranks), InputError);
}

TEST(CaseFileExample, EdgeCrackIsThatOfThePaper) {
  const auto spec = read_case(std::string(CDCA_SOURCE_DIR) + "/examples/edge_crack.toml");
  EXPECT_EQ(spec.domain.size, Vec2(0.020, 0.052));
  EXPECT_EQ(spec.domain.cells, (std::array{39, 103}));
  EXPECT_FALSE(spec.domain.plane_strain);
  EXPECT_EQ(spec.material.young, 76e9);
  EXPECT_EQ(spec.material.poisson, 0.286);
  ASSERT_EQ(spec.cracks.size(), 1u);
  EXPECT_EQ(spec.cracks[0].points, (std::vector<Vec2>{{0.0, 0.026}, {0.012, 0.026}}));
  double pull = 0.0;
  for (const auto& block : spec.boundaries) {
    if (!block.traction[1]) continue;
    EXPECT_EQ(std::abs(block.traction[1]->at(0.01, 0.0, 1.0)), 0.2e9);
    pull += block.traction[1]->at(0.01, 0.0, 1.0);
  }
  EXPECT_EQ(pull, 0.0);
}

TEST(CaseFileDescription, NamesSizesCracksAndLoads) {
  const auto text = describe_case(read(plate), {800, 861, 1800, 3, 2'500'000});
  for (const auto* part :
       {"2 x 4 m", "20 x 40 elements of 0.1 x 0.1 m", "plane stress", "E = 1e+09 Pa",
        "2, 1.35 m in all; active tips: 3", "edge: 2 points from [0, 2] to [0.95, 2], 0.95 m",
        "4 steps, load factor 0.25 to 1", "bottom, displacement [free, 0.0] m",
        "top, traction [0, 1000000.0] Pa", "800 elements, 861 nodes, 1800 unknowns",
        "about 2.5 MB"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
}

}  // namespace
}  // namespace cdca
