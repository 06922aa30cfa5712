// SPDX-License-Identifier: BSD-3-Clause
#include "io/log.hpp"
#include "tests/io/output_samples.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace cdca {
namespace {

using testing::sample_summary;
using testing::ScratchFolder;
using testing::text_of;

/// What a log prints over two load steps.
std::string printed(bool bar) {
  const ScratchFolder folder;
  std::FILE* out = std::fopen((folder / "log").c_str(), "w");
  ProgressLog log(out, 2, bar);
  Summary summary = sample_summary();
  const auto steps = summary.steps;
  log.on_start(summary);
  for (std::size_t s = 0; s < 2; ++s) {
    summary.steps.assign(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(s) + 1);
    const std::vector<TipRecord> none;
    log.on_step({summary, nullptr, nullptr, none, s == 1});
  }
  summary.status = "completed";
  log.on_finish(summary);
  std::fclose(out);
  return text_of(folder / "log");
}

TEST(OutputLog, SaysWhatAStepBrought) {
  EXPECT_EQ(step_line(sample_summary(), 10),
            "step 2/10  load 1  K_I 0.3333 MPa m^1/2  tips 1  growth cycles 2  iterations 41  "
            "wall 0.5 s");
}

TEST(OutputLog, LeavesOutKWhereNoTipIsActive) {
  Summary summary = sample_summary();
  summary.tips.pop_back();
  EXPECT_EQ(step_line(summary, 2).find("K_I"), std::string::npos);
}

TEST(OutputLog, GuessesTheTimeLeft) {
  EXPECT_EQ(progress_bar(1, 4, 30.0),
            "[##########------------------------------] 25 %, 1 min 30 s left");
  EXPECT_EQ(progress_bar(4, 4, 30.0).substr(0, 49),
            "[########################################] 100 %,");
  EXPECT_NE(progress_bar(1, 1000, 20.0).find("5 h 33 min left"), std::string::npos);
  EXPECT_NE(progress_bar(0, 10, 1.0).find("time left unknown"), std::string::npos);
}

TEST(OutputLog, PrintsPlainLinesIntoAFile) {
  const std::string text = printed(false);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
  EXPECT_EQ(text.find_first_of("\r\x1b#"), std::string::npos);
  EXPECT_EQ(text.rfind("A plate: 4017 elements, 4160 nodes, 8400 unknowns on 2 ranks\n", 0), 0u);
  EXPECT_NE(text.find("\nstep 1/2  load 0.5 "), std::string::npos);
  EXPECT_NE(text.find("\ncompleted\n"), std::string::npos);
}

TEST(OutputLog, DrawsABarOnATerminalAndTakesItAwayAgain) {
  const std::string text = printed(true);
  EXPECT_NE(text.find("] 50 %"), std::string::npos);
  EXPECT_EQ(text.find("] 100 %"), std::string::npos) << "nothing is left to wait for";
  const auto bar = text.find("[#");
  ASSERT_NE(bar, std::string::npos);
  EXPECT_LT(text.find('\r', bar), text.find('\n', bar)) << "the next line must replace the bar";
}

TEST(OutputLog, IsSilentWithoutAnOutput) {
  ProgressLog log(nullptr, 2, true);
  const Summary summary = sample_summary();
  const std::vector<TipRecord> none;
  ::testing::internal::CaptureStdout();
  log.on_start(summary);
  log.on_step({summary, nullptr, nullptr, none, false});
  log.on_finish(summary);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace cdca
