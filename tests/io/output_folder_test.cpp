// SPDX-License-Identifier: BSD-3-Clause
// The result folder of a run, as its writer leaves it step by step.
#include "core/base/errors.hpp"
#include "io/paraview_index.hpp"
#include "io/result_writer.hpp"
#include "io/text_file.hpp"
#include "parallel/together.hpp"
#include "tests/io/output_samples.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLPUnstructuredGridReader.h>

namespace cdca {
namespace {

using testing::sample_cracks;
using testing::sample_fields;
using testing::sample_summary;
using testing::ScratchFolder;
using testing::text_of;

struct Listed {
  double time;
  std::string file;
};

/// The steps that a .pvd lists, read by an XML parser.
std::vector<Listed> listed_in(const std::filesystem::path& pvd) {
  vtkNew<vtkXMLDataParser> parser;
  parser->SetFileName(pvd.c_str());
  EXPECT_EQ(parser->Parse(), 1) << pvd;
  auto* root = parser->GetRootElement();
  auto* collection = root->FindNestedElementWithName("Collection");
  std::vector<Listed> steps;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    auto* entry = collection->GetNestedElement(i);
    steps.push_back(
        {std::strtod(entry->GetAttribute("timestep"), nullptr), entry->GetAttribute("file")});
  }
  return steps;
}

vtkIdType cells_in(const std::filesystem::path& pvtu) {
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName(pvtu.c_str());
  reader->Update();
  return reader->GetOutput()->GetNumberOfCells();
}

/// Runs `steps` load steps of equal size through a writer.
void run(Observer& writer, int steps) {
  Summary summary = sample_summary();
  const StepRecord row = summary.steps[0];
  summary.steps.clear();
  writer.on_start(summary);
  for (int s = 1; s <= steps; ++s) {
    summary.steps.push_back(row);
    summary.steps.back().step = s;
    summary.steps.back().load_factor = summary.load_factor = static_cast<double>(s) / steps;
    const std::vector<TipRecord> tips(2);
    writer.on_step({summary, [] { return sample_fields(0, 0.0); }, [] { return sample_cracks(); },
                    tips, s == steps});
  }
  summary.status = "completed";
  writer.on_finish(summary);
}

TEST(OutputFolder, HoldsEverythingAfterARun) {
  const ScratchFolder folder;
  SerialCommunicator comm;
  ResultWriter writer(folder / "a/b", 1, comm, "title = \"x\"\n");
  run(writer, 3);
  const auto results = folder / "a/b";
  EXPECT_EQ(text_of(results / "effective.toml"), "title = \"x\"\n");
  const auto summary = nlohmann::json::parse(text_of(results / "summary.json"));
  EXPECT_EQ(summary["status"], "completed");
  EXPECT_EQ(summary["steps"].size(), 3u);
  const auto history = text_of(results / "history.csv");
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 1 + 3);
  const auto tips = text_of(results / "tips.csv");
  EXPECT_EQ(std::count(tips.begin(), tips.end(), '\n'), 1 + 3 * 2);
  for (const std::string name : {"fields", "cracks"}) {
    const auto steps = listed_in(results / (name + ".pvd"));
    ASSERT_EQ(steps.size(), 3u);
    EXPECT_EQ(steps[0].time, 1.0 / 3.0);
    EXPECT_EQ(steps[2].time, 1.0);
    EXPECT_EQ(steps[2].file, name + "/step_0003.pvtu");
    for (const auto& step : steps) EXPECT_GT(cells_in(results / step.file), 0);
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(results))
    EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
}

TEST(OutputFolder, WritesFieldsEveryFewStepsAndAtTheLast) {
  const ScratchFolder folder;
  SerialCommunicator comm;
  ResultWriter writer(folder.path(), 3, comm);
  run(writer, 7);
  std::vector<std::string> files;
  for (const auto& step : listed_in(folder / "fields.pvd")) files.push_back(step.file);
  EXPECT_EQ(files, (std::vector<std::string>{"fields/step_0003.pvtu", "fields/step_0006.pvtu",
                                             "fields/step_0007.pvtu"}));
  EXPECT_FALSE(std::filesystem::exists(folder / "fields/step_0001_0000.vtu"));
}

/// Looks into the folder after each step, as a user who watches a run does.
class Watcher : public Observer {
 public:
  Watcher(ResultWriter& writer, std::filesystem::path folder)
      : writer_(writer), folder_(std::move(folder)) {}
  void on_start(const Summary& summary) override { writer_.on_start(summary); }
  void on_step(const StepView& view) override {
    writer_.on_step(view);
    const auto shown = nlohmann::json::parse(text_of(folder_ / "summary.json"));
    seen.push_back(listed_in(folder_ / "fields.pvd").size());
    EXPECT_EQ(shown["steps"].size(), view.summary.steps.size());
    EXPECT_EQ(shown["status"], "running");
  }
  std::vector<std::size_t> seen;

 private:
  ResultWriter& writer_;
  std::filesystem::path folder_;
};

TEST(OutputFolder, IsCompleteAfterEveryStep) {
  const ScratchFolder folder;
  SerialCommunicator comm;
  ResultWriter writer(folder.path(), 1, comm);
  Watcher watcher(writer, folder.path());
  run(watcher, 4);
  EXPECT_EQ(watcher.seen, (std::vector<std::size_t>{1, 2, 3, 4}));
}

TEST(OutputFolder, ForgetsTheRunBeforeButNothingElse) {
  const ScratchFolder folder;
  SerialCommunicator comm;
  {
    ResultWriter writer(folder.path(), 1, comm);
    run(writer, 5);
  }
  write_text(folder / "opened.png", "an old picture");
  write_text(folder / "notes.txt", "of the user");
  write_text(folder / "fields/notes.txt", "of the user too");
  ResultWriter writer(folder.path(), 1, comm);
  run(writer, 2);
  EXPECT_EQ(listed_in(folder / "fields.pvd").size(), 2u);
  EXPECT_FALSE(std::filesystem::exists(folder / "fields/step_0005.pvtu"));
  EXPECT_FALSE(std::filesystem::exists(folder / "cracks/step_0005_0000.vtu"));
  EXPECT_FALSE(std::filesystem::exists(folder / "opened.png"));
  EXPECT_EQ(text_of(folder / "notes.txt"), "of the user");
  EXPECT_EQ(text_of(folder / "fields/notes.txt"), "of the user too");
  const auto tips = text_of(folder / "tips.csv");
  EXPECT_EQ(std::count(tips.begin(), tips.end(), '\n'), 1 + 2 * 2);
}

TEST(OutputFolder, RefusesAFolderThatItCannotMake) {
  const ScratchFolder folder;
  SerialCommunicator comm;
  write_text(folder / "file", "in the way");
  EXPECT_THROW(ResultWriter(folder / "file", 1, comm), IoError);
  EXPECT_THROW(ResultWriter(folder / "file/below", 1, comm), IoError);
}

TEST(OutputFolder, SaysSoWhenAFolderVanishes) {
  const ScratchFolder folder;
  SerialCommunicator comm;
  ResultWriter writer(folder / "gone", 1, comm);
  std::filesystem::remove_all(folder / "gone");
  write_text(folder / "gone", "a file now");
  EXPECT_THROW(run(writer, 1), IoError);
}

TEST(OutputIndex, TimeIsTheStepWhenTheLoadGoesBack) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "fields");
  ParaviewSeries series(folder.path(), "fields", field_arrays());
  series.add(1, 0.5, 1);
  series.add(2, 0.75, 1);
  EXPECT_EQ(listed_in(folder / "fields.pvd")[1].time, 0.75);
  series.add(4, 0.6, 1);
  const auto steps = listed_in(folder / "fields.pvd");
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[0].time, 1.0);
  EXPECT_EQ(steps[1].time, 2.0);
  EXPECT_EQ(steps[2].time, 4.0);
}

TEST(OutputIndex, StepsBeyondFourDigitsKeepTheirNames) {
  EXPECT_EQ(step_file(7), "step_0007.pvtu");
  EXPECT_EQ(step_file(12345), "step_12345.pvtu");
  EXPECT_EQ(piece_file(7, 3), "step_0007_0003.vtu");
}

TEST(OutputTogether, PassesOnWhatWentWrong) {
  SerialCommunicator comm;
  EXPECT_NO_THROW(together(comm, [] {}));
  try {
    together(comm, [] { throw std::runtime_error("no space left"); });
    FAIL() << "the failure was lost";
  } catch (const IoError& error) {
    EXPECT_STREQ(error.what(), "no space left");
  }
}

TEST(OutputTextFile, ReplacesAndAppends) {
  const ScratchFolder folder;
  write_text(folder / "t", "a long first version\n");
  write_text(folder / "t", "second\n");
  append_text(folder / "t", "third\n");
  EXPECT_EQ(text_of(folder / "t"), "second\nthird\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "t.tmp"));
  EXPECT_THROW(write_text(folder / "none/t", "x"), IoError);
  EXPECT_THROW(append_text(folder / "none/t", "x"), IoError);
}

TEST(OutputTextFile, NoticesAFullDisk) {
  ASSERT_TRUE(std::filesystem::exists("/dev/full"));  // Linux always has it
  EXPECT_THROW(append_text("/dev/full", "x"), IoError);
}

}  // namespace
}  // namespace cdca
