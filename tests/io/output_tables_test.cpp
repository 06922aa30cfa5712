// SPDX-License-Identifier: BSD-3-Clause
// summary.json, history.csv and tips.csv are what docs/results.md says.
#include "io/csv_tables.hpp"
#include "io/summary_json.hpp"
#include "tests/io/output_samples.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace cdca {
namespace {

using nlohmann::json;
using testing::sample_summary;

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> keys_of(const nlohmann::ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

using Keys = std::vector<std::string>;

TEST(OutputSummary, HasTheKeysOfTheContract) {
  const auto top = nlohmann::ordered_json::parse(summary_json(sample_summary()));
  EXPECT_EQ(keys_of(top),
            (Keys{"version", "title", "status", "message", "ranks", "elements", "nodes", "unknowns",
                  "load_factor", "steps", "tips", "cracks", "network", "events", "performance"}));
  EXPECT_EQ(keys_of(top["tips"][1]), (Keys{"crack", "end", "x", "y", "state", "partner", "K_I",
                                           "K_II", "U_tension", "U_shear", "angle_deg"}));
  EXPECT_EQ(keys_of(top["cracks"][0]), (Keys{"name", "points", "length"}));
  EXPECT_EQ(keys_of(top["network"]), (Keys{"clusters", "largest", "spans_x", "spans_y"}));
  EXPECT_EQ(keys_of(top["events"][0]),
            (Keys{"step", "cycle", "kind", "crack", "end", "partner", "at"}));
  EXPECT_EQ(keys_of(top["performance"]),
            (Keys{"wall_s", "setup_s", "solve_s", "output_s", "linear_solves", "solver_iterations",
                  "peak_rss_bytes", "unknowns_per_rank"}));
  EXPECT_EQ(keys_of(top["steps"][0]),
            (Keys{"step", "load_factor", "reaction_x_bottom", "reaction_y_bottom", "reaction_x_top",
                  "reaction_y_top", "strain_energy", "crack_length", "active_tips", "growth_cycles",
                  "solver_iterations", "wall_s", "external_work", "dissipated", "friction_work",
                  "contact_iterations", "contact_unbalanced"}));
}

TEST(OutputSummary, HoldsTheValuesExactly) {
  const auto summary = sample_summary();
  const json top = json::parse(summary_json(summary));
  EXPECT_EQ(top["status"], "running");
  EXPECT_EQ(top["ranks"], 2);
  EXPECT_EQ(top["unknowns"], 8400);
  EXPECT_EQ(top["steps"].size(), 2u);
  EXPECT_EQ(top["steps"][1]["reaction_y_top"], 20.0);
  EXPECT_EQ(top["steps"][1]["growth_cycles"], 2);
  EXPECT_EQ(top["tips"][1]["K_I"].get<double>(), summary.tips[1].k1);  // 1/3: all digits survive
  EXPECT_EQ(top["tips"][1]["K_II"], -12.5);
  EXPECT_EQ(top["tips"][1]["angle_deg"].get<double>(), -0.1);
  EXPECT_EQ(top["cracks"][0]["points"], json::parse("[[0.0, 0.026], [0.012, 0.026]]"));
  EXPECT_EQ(top["network"]["spans_x"], false);
  EXPECT_EQ(top["events"][0]["kind"], "boundary");
  EXPECT_EQ(top["events"][0]["at"], json::parse("[0.0, 0.026]"));
  EXPECT_EQ(top["performance"]["peak_rss_bytes"], json::parse("[100000000, 110000000]"));
  EXPECT_EQ(top["performance"]["wall_s"], 1.25);
}

TEST(OutputSummary, WhatIsNotThereIsNull) {
  auto summary = sample_summary();
  summary.tips[1].k1 = not_a_number;
  summary.steps[0].strain_energy = std::numeric_limits<double>::infinity();
  const json top = json::parse(summary_json(summary));  // NaN and Infinity are no JSON
  EXPECT_TRUE(top["tips"][1]["K_I"].is_null());
  EXPECT_EQ(top["tips"][1]["K_II"], -12.5);
  EXPECT_TRUE(top["tips"][0]["K_I"].is_null()) << "a tip on the boundary has no K";
  EXPECT_TRUE(top["tips"][0]["partner"].is_null());
  EXPECT_TRUE(top["events"][0]["partner"].is_null());
  EXPECT_EQ(top["events"][0]["crack"], 0);
  EXPECT_TRUE(top["steps"][0]["strain_energy"].is_null());
}

TEST(OutputSummary, EmptyRunsAreSound) {
  const json top = json::parse(summary_json(Summary{}));
  for (const char* key : {"steps", "tips", "cracks", "events"})
    EXPECT_EQ(top[key], json::array()) << key;
  EXPECT_EQ(top["performance"]["unknowns_per_rank"], json::array());
}

TEST(OutputSummary, TextOfTheUserCannotBreakIt) {
  auto summary = sample_summary();
  summary.title = "says \"hello\"\n\\ and a broken byte \xff";
  summary.cracks[0].name = "Riß";
  const json top = json::parse(summary_json(summary));
  EXPECT_EQ(top["title"].get<std::string>().substr(0, 14), "says \"hello\"\n\\");
  EXPECT_EQ(top["cracks"][0]["name"], "Riß");
}

TEST(OutputTables, HistoryHasARowPerStep) {
  auto summary = sample_summary();
  summary.steps[1].external_work = 7.5;
  summary.steps[1].dissipated = 1.5;
  summary.steps[1].friction_work = 0.5;
  summary.steps[1].contact_iterations = 4;
  summary.steps[1].contact_unbalanced = 1e-3;
  const auto lines = lines_of(history_csv(summary));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "step,load_factor,reaction_x_bottom,reaction_y_bottom,reaction_x_top,reaction_y_top,"
            "strain_energy,crack_length,active_tips,growth_cycles,solver_iterations,wall_s,"
            "external_work,dissipated,friction_work,contact_iterations,contact_unbalanced");
  EXPECT_EQ(lines[1], "1,0.5,0,-10,0,10,1.5,0.012,1,1,40,0.25,0,0,0,0,0");
  EXPECT_EQ(lines[2], "2,1,0.1,-20,-0.1,20,6,0.013,1,2,41,0.5,7.5,1.5,0.5,4,0.001");
}

TEST(OutputTables, HistoryBeforeTheFirstStepIsItsHeader) {
  auto summary = sample_summary();
  summary.steps.clear();
  EXPECT_EQ(lines_of(history_csv(summary)).size(), 1u);
  summary.reaction_names.clear();
  EXPECT_EQ(lines_of(history_csv(summary))[0],
            "step,load_factor,strain_energy,crack_length,active_tips,growth_cycles,"
            "solver_iterations,wall_s,external_work,dissipated,friction_work,contact_iterations,"
            "contact_unbalanced");
}

TEST(OutputTables, TipsHaveTheColumnsOfTheContract) {
  EXPECT_EQ(tips_csv_header(),
            "step,cycle,crack,end,x,y,K_I,K_II,K_from,U_tension,U_shear,angle_deg,mode,growth,"
            "K_radius\n");
  TipRecord tip;
  tip.step = 3;
  tip.cycle = 2;
  tip.crack = 1;
  tip.end = 1;
  tip.at = {0.25, -0.5};
  tip.k1 = 1e6 / 3.0;
  tip.k2 = -7.0;
  tip.k_from = "fit";
  tip.u_tension = 1.25;
  tip.u_shear = 0.5;
  tip.angle_deg = 70.5;
  tip.mode = "mixed";
  tip.growth = 0.001;
  tip.k_radius = 0.0625;
  EXPECT_EQ(tips_csv_rows({tip}),
            "3,2,1,1,0.25,-0.5,333333.3333333333,-7,fit,1.25,0.5,70.5,mixed,0.001,0.0625\n");
  EXPECT_EQ(lines_of(tips_csv_rows({tip, tip, tip})).size(), 3u);
  EXPECT_EQ(tips_csv_rows({}), "");
}

TEST(OutputTables, NumbersReadBackAsTheyWere) {
  auto summary = sample_summary();
  const std::vector<double> awkward{0.1,    1.0 / 3.0, std::nextafter(1.0, 2.0),
                                    5e-324, -1.7e308,  123456789.12345678};
  for (const double value : awkward) {
    summary.steps[0].strain_energy = value;
    const std::string row = lines_of(history_csv(summary))[1];
    std::istringstream in(row);
    std::string text;
    for (int column = 0; column < 7; ++column) std::getline(in, text, ',');
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), value) << row;
  }
}

TEST(OutputTables, NamesWithCommasStayOneColumn) {
  auto summary = sample_summary();
  summary.reaction_names[1] = "top, \"left\"";
  const auto header = lines_of(history_csv(summary))[0];
  EXPECT_NE(header.find("\"reaction_x_top, \"\"left\"\"\""), std::string::npos) << header;
}

}  // namespace
}  // namespace cdca
