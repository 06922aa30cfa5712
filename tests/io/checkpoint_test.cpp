// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints as files, written by some ranks and read by others.
#include "core/base/errors.hpp"
#include "io/case_match.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/checkpoint_writer.hpp"
#include "tests/io/case_samples.hpp"
#include "tests/io/checkpoint_samples.hpp"
#include "tests/world.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace cdca {
namespace {

namespace fs = std::filesystem;
using namespace testing;

/// A folder that all ranks of the test know, removed afterwards.
class SharedFolder {
 public:
  SharedFolder() {
    Bytes bytes;
    if (world().is_root()) {
      std::string name = (fs::temp_directory_path() / "cdca_checkpoint_XXXXXX").string();
      if (!mkdtemp(name.data())) throw IoError("no folder");
      pack(bytes, std::span<const char>(name));
    }
    world().broadcast(bytes);
    const auto letters = unpack<char>(bytes);
    path_ = std::string(letters.begin(), letters.end());
  }
  ~SharedFolder() {
    std::error_code ignored;
    world().barrier();
    if (world().is_root()) fs::remove_all(path_, ignored);
  }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// Rank r has cells [40 r, 40 r + 40); the last one has none when there are several ranks.
Checkpoint checkpoint_of_this_rank() {
  Checkpoint c = sample_checkpoint();
  const std::int64_t first = 40 * world().rank();
  const bool has_none = world().size() > 1 && world().rank() + 1 == world().size();
  c.cells = sample_cells(first, has_none ? first : first + 40);
  return c;
}

void expect_same_cells(const CellFields& a, const CellFields& b) {
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.counts, b.counts);
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.force, b.force);
}

TEST(CheckpointParallel, GivesBackWhatWasWritten) {
  const SharedFolder folder;
  const auto file = folder / "checkpoint-2.h5";
  write_checkpoint(file, checkpoint_of_this_rank(), sample_origin(), world());
  EXPECT_FALSE(fs::exists(folder / "checkpoint-2.h5.tmp"));
  const std::int64_t ranks = world().size(), cells = 40 * std::max<std::int64_t>(1, ranks - 1);
  const auto stored = read_checkpoint(file, world());
  EXPECT_EQ(stored.origin.version, "0.1.0");
  EXPECT_EQ(stored.origin.title, sample_origin().title);
  EXPECT_EQ(stored.origin.effective_case, sample_origin().effective_case);
  expect_same(stored.checkpoint, sample_checkpoint());
  const std::int64_t rank = world().rank();
  expect_same_cells(stored.checkpoint.cells,
                    sample_cells(cells * rank / ranks, cells * (rank + 1) / ranks));
}

TEST(CheckpointParallel, OfAllRanksIsReadByOne) {
  const SharedFolder folder;
  const auto file = folder / "checkpoint-2.h5";
  write_checkpoint(file, checkpoint_of_this_rank(), sample_origin(), world());
  world().barrier();
  SerialCommunicator alone;
  const auto stored = read_checkpoint(file, alone);
  expect_same(stored.checkpoint, sample_checkpoint());
  expect_same_cells(stored.checkpoint.cells, sample_cells(0, 40 * std::max(1, world().size() - 1)));
}

TEST(CheckpointParallel, OfOneRankIsReadByAll) {
  const SharedFolder folder;
  const auto file = folder / "checkpoint-2.h5";
  Checkpoint c = sample_checkpoint();
  c.cells = sample_cells(0, 50);
  SerialCommunicator alone;
  if (world().is_root()) write_checkpoint(file, c, sample_origin(), alone);
  world().barrier();
  const auto stored = read_checkpoint(file, world());
  expect_same(stored.checkpoint, c);
  const std::int64_t ranks = world().size(), rank = world().rank();
  expect_same_cells(stored.checkpoint.cells,
                    sample_cells(50 * rank / ranks, 50 * (rank + 1) / ranks));
}

/// A byte anywhere in the file that is not what it was: every rank says so, or the values are
/// right all the same (some bytes of a file mean nothing).
TEST(CheckpointParallel, TellsDamage) {
  const SharedFolder folder;
  const auto file = folder / "checkpoint-2.h5";
  write_checkpoint(file, checkpoint_of_this_rank(), sample_origin(), world());
  world().barrier();
  const std::string whole = text_of(file);
  int refused = 0, tried = 0;
  for (std::size_t at = 3; at < whole.size(); at += whole.size() / 40) {
    std::string text = whole;
    text[at] = char(text[at] ^ 0x55);
    world().barrier();
    if (world().is_root()) std::ofstream(file, std::ios::binary) << text;
    world().barrier();
    ++tried;
    try {
      expect_same(read_checkpoint(file, world()).checkpoint, sample_checkpoint());
    } catch (const IoError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, tried / 2);
  for (const std::size_t length : {std::size_t(0), whole.size() / 3, whole.size() - 1}) {
    world().barrier();
    if (world().is_root()) std::ofstream(file, std::ios::binary) << whole.substr(0, length);
    world().barrier();
    EXPECT_THROW(read_checkpoint(file, world()), IoError) << length;
  }
}

TEST(CheckpointParallel, ThatCannotBeWrittenIsAnErrorOnAllRanks) {
  EXPECT_THROW(write_checkpoint("/no/such/folder/checkpoint-1.h5", checkpoint_of_this_rank(),
                                sample_origin(), world()),
               IoError);
}

TEST(CheckpointFile, MayBeAlmostEmpty) {
  const SharedFolder folder;
  const auto file = folder / "checkpoint-0.h5";
  SerialCommunicator alone;
  write_checkpoint(file, {}, {}, alone);
  expect_same(read_checkpoint(file, alone).checkpoint, {});
}

TEST(CheckpointFile, OfAnotherProgramIsRefused) {
  const SharedFolder folder;
  std::ofstream(folder / "checkpoint-1.h5") << "something else";
  SerialCommunicator alone;
  EXPECT_THROW(read_checkpoint(folder / "checkpoint-1.h5", alone), IoError);
  EXPECT_THROW(read_checkpoint(folder / "none.h5", alone), IoError);
}

TEST(CheckpointFolder, KnowsItsFiles) {
  const SharedFolder folder;
  for (const auto* name : {"checkpoint-9.h5", "checkpoint-10.h5", "checkpoint-100.h5",
                           "checkpoint-x.h5", "checkpoint-.h5", "checkpoint-7.h5.tmp", "other.h5"})
    std::ofstream(folder / name) << name;
  EXPECT_EQ(checkpoint_path("a", 12), fs::path("a/checkpoint-12.h5"));
  std::vector<std::string> names;
  for (const auto& file : checkpoints_in(folder / ".")) names.push_back(file.filename());
  EXPECT_EQ(names,
            (std::vector<std::string>{"checkpoint-100.h5", "checkpoint-10.h5", "checkpoint-9.h5"}));
  keep_newest_checkpoints(folder / ".", 2);
  EXPECT_FALSE(fs::exists(folder / "checkpoint-9.h5"));
  EXPECT_FALSE(fs::exists(folder / "checkpoint-7.h5.tmp"));
  EXPECT_TRUE(fs::exists(folder / "checkpoint-x.h5") && fs::exists(folder / "other.h5"));
  remove_checkpoints_after(folder / ".", 10);
  EXPECT_FALSE(fs::exists(folder / "checkpoint-100.h5"));
  EXPECT_TRUE(fs::exists(folder / "checkpoint-10.h5"));
}

/// Goes through `steps` load steps with two growth cycles in each; returns whether it was stopped,
/// and where.
std::pair<int, int> rest(CheckpointWriter& writer, int steps) {
  writer.on_start({});
  for (int step = 1; step <= steps; ++step) {
    for (int cycle = 1; cycle <= 3; ++cycle) {
      const Progress at =
          cycle < 3 ? Progress{step - 1, cycle, 0, 0, true} : Progress{step, 0, 0, 0, true};
      const bool last = step == steps && cycle == 3;
      if (writer.on_rest({at, checkpoint_of_this_rank, last})) return {step, cycle};
    }
  }
  return {0, 0};
}

/// What all ranks see; none goes on before all have looked.
std::vector<int> steps_in(const fs::path& folder) {
  world().barrier();
  std::vector<int> steps;
  for (const auto& file : checkpoints_in(folder)) steps.push_back(*checkpoint_step(file));
  world().barrier();
  return steps;
}

TEST(CheckpointWriterParallel, KeepsTheNewestTwo) {
  const SharedFolder folder;
  const auto never = [] { return false; };
  CheckpointWriter writer(folder / ".", 3, sample_origin(), never, world());
  EXPECT_EQ(rest(writer, 10).first, 0);
  EXPECT_EQ(steps_in(folder / "."), (std::vector<int>{9, 6}));
  CheckpointWriter none(folder / ".", 0, sample_origin(), never, world());
  rest(none, 4);
  EXPECT_EQ(steps_in(folder / "."), std::vector<int>()) << "those of an earlier run are gone";
}

TEST(CheckpointWriterParallel, StopsAllRanksWhenOneIsAsked) {
  const SharedFolder folder;
  const int asked = world().size() - 1;
  int looks = 0;
  const auto at_fifth_look = [&] { return ++looks == 5 && world().rank() == asked; };
  CheckpointWriter writer(folder / ".", 0, sample_origin(), at_fifth_look, world());
  EXPECT_EQ(rest(writer, 9), (std::pair<int, int>{2, 2}));
  EXPECT_EQ(steps_in(folder / "."), std::vector<int>{2});
  looks = -1;  // the sixth look is the last one: the run is over anyway
  CheckpointWriter late(folder / ".", 0, sample_origin(), at_fifth_look, world());
  EXPECT_EQ(rest(late, 2).first, 0);
}

TEST(CheckpointWriterParallel, LeavesWhatTheContinuedRunNeeds) {
  const SharedFolder folder;
  const auto never = [] { return false; };
  CheckpointWriter first(folder / ".", 1, sample_origin(), never, world());
  rest(first, 5);
  CheckpointWriter second(folder / ".", 1, sample_origin(), never, world(),
                          folder / "checkpoint-4.h5");
  second.on_start({});
  EXPECT_EQ(steps_in(folder / "."), std::vector<int>{4});
  CheckpointWriter elsewhere(folder / ".", 1, sample_origin(), never, world(),
                             fs::path("/other/checkpoint-4.h5"));
  elsewhere.on_start({});
  EXPECT_EQ(steps_in(folder / "."), std::vector<int>());
}

TEST(CaseMatch, NamesTheKeyThatDiffers) {
  const auto text = changed(plate, "[solver]", "[contact]\nlaw = \"none\"\n[solver]");
  const auto effective = [](const std::string& t) { return read_case_text(t, "a").effective; };
  const auto differing = [&](const std::string& from, const std::string& to) -> std::string {
    try {
      require_same_case(effective(text), effective(changed(text, from, to)), "checkpoint-3.h5");
      return "";
    } catch (const InputError& error) {
      const Problem& p = error.problems().front();
      EXPECT_NE(p.message.find("checkpoint-3.h5"), std::string::npos);
      return p.key;
    }
  };
  EXPECT_EQ(differing("cells = [20, 40]", "cells = [20, 42]"), "domain.cells");
  EXPECT_EQ(differing("young = 1e9", "young = 1.1e9"), "material.young");
  EXPECT_EQ(differing("law = \"none\"", "law = \"frictionless\"\nnormal_stiffness = 1e12"),
            "contact.law");
  EXPECT_EQ(differing("[0.95, 2.0]", "[0.9, 2.0]"), "crack[0].points");
  EXPECT_EQ(differing("angle = 30.0", "angle = 30.0\nfriction = 0.1\nlaw = \"none\""),
            "crack[1].law");
  EXPECT_EQ(differing("traction = [0.0, 1e6]", "traction = [0.0, 2e6]"), "boundary[2].traction");
  EXPECT_EQ(differing("[[boundary]]\non = \"top\"",
                      "[[boundary]]\non = \"left\"\ntraction = [1.0, 0.0]\n[[boundary]]\non = "
                      "\"top\""),
            "boundary[2].on");
  EXPECT_EQ(differing("[solver]", "[crack_field]\ncount = 1\nlength = [0.1, 0.1]\n[solver]"),
            "crack_field.count");
  EXPECT_EQ(differing("[solver]", "[enrichment]\ntip_radius = 0.1\n[solver]"),
            "enrichment.tip_radius");
  // what may change
  EXPECT_EQ(differing("title = \"Plate\"", "title = \"Other\""), "");
  EXPECT_EQ(differing("steps = 4", "factors = [0.5, 1.5]"), "");
  EXPECT_EQ(differing("tolerance = 1e-9", "tolerance = 1e-7\nmethod = \"krylov\""), "");
  EXPECT_EQ(differing("every = 2", "every = 3"), "");
  EXPECT_EQ(differing("young = 1e9", "young = 1000000000"), "");
}

}  // namespace
}  // namespace cdca
