// SPDX-License-Identifier: BSD-3-Clause
#include "io/checkpoint_file.hpp"

#include "core/base/errors.hpp"
#include "io/checkpoint_columns.hpp"
#include "io/checkpoint_table.hpp"
#include "io/checksum.hpp"
#include "parallel/together.hpp"

#include <system_error>

namespace cdca {
namespace {

namespace fs = std::filesystem;

/// Of the arrays and their meaning; another one cannot be read.
constexpr std::int64_t layout = 7;

void put_cracks(Hdf5Output& file, const std::vector<Crack>& cracks) {
  std::vector<PointRow> points;
  std::vector<SegmentRow> segments;
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    for (const Vec2& at : cracks[c].points) points.push_back({int(c), at});
    for (const GrowthTime& born : cracks[c].born) segments.push_back({int(c), born});
  }
  put_table(file, "cracks", cracks, crack_columns);
  put_table(file, "crack_points", points, point_columns);
  put_table(file, "crack_segments", segments, segment_columns);
}

std::vector<Crack> read_cracks(const Hdf5Input& file) {
  auto cracks = read_table<Crack>(file, "cracks", crack_columns);
  for (const auto& row : read_table<PointRow>(file, "crack_points", point_columns))
    cracks.at(std::size_t(row.crack)).points.push_back(row.at);
  for (const auto& row : read_table<SegmentRow>(file, "crack_segments", segment_columns))
    cracks.at(std::size_t(row.crack)).born.push_back(row.born);
  return cracks;
}

void put_steps(Hdf5Output& file, const std::vector<StepRecord>& steps) {
  std::vector<ReactionRow> reactions;
  for (const StepRecord& step : steps) {
    for (const auto& force : step.reactions)
      reactions.push_back({step.step, Vec2(force[0], force[1])});
  }
  put_table(file, "steps", steps, step_columns);
  put_table(file, "reactions", reactions, reaction_columns);
}

std::vector<StepRecord> read_steps(const Hdf5Input& file) {
  auto steps = read_table<StepRecord>(file, "steps", step_columns);
  const auto reactions = read_table<ReactionRow>(file, "reactions", reaction_columns);
  const std::size_t of_each = steps.empty() ? 0 : reactions.size() / steps.size();
  for (std::size_t k = 0; k < of_each * steps.size(); ++k)
    steps[k / of_each].reactions.push_back({reactions[k].force.x(), reactions[k].force.y()});
  return steps;
}

void put_cells(Hdf5Output& file, const CellFields& cells) {
  file.put_parts("cells/node", "", cells.nodes);
  file.put_parts("cells/unknowns", "", cells.counts);
  file.put_parts("cells/displacement", "m", cells.displacement);
  file.put_parts("cells/force", "N/m", cells.force);
}

/// This rank's share of a list.
struct Share {
  std::int64_t first = 0;
  std::int64_t count = 0;
};

Share share_of(std::int64_t total, const Communicator& ranks) {
  const std::int64_t first = total * ranks.rank() / ranks.size();
  return {first, total * (ranks.rank() + 1) / ranks.size() - first};
}

template <class T>
void check_parts(const Hdf5Part<T>& part, const std::string& name, const fs::path& file,
                 Communicator& ranks) {
  const auto bytes = std::int64_t(part.values.size() * sizeof(T));
  if (joint_checksum(part.checksum, bytes, ranks) != part.expected)
    throw IoError("Cannot read " + file.string() + ": the checksum of " + name + " is wrong.");
}

CellFields read_cells(const fs::path& path, Communicator& ranks) {
  Hdf5Part<std::int64_t> nodes, counts;
  together(ranks, [&] {
    const Hdf5Input file(path);
    const Share rows = share_of(file.size("cells/node"), ranks);
    file.read("cells/node", rows.first, rows.count, nodes);
    file.read("cells/unknowns", rows.first, rows.count, counts);
  });
  check_parts(nodes, "cells/node", path, ranks);
  check_parts(counts, "cells/unknowns", path, ranks);
  std::vector<std::int64_t> values(std::size_t(ranks.size()), 0);
  auto& mine = values[std::size_t(ranks.rank())];
  for (const std::int64_t count : counts.values) mine += count;
  const std::int64_t length = mine;
  ranks.sum(std::span<std::int64_t>(values));
  std::int64_t first = 0;
  for (int r = 0; r < ranks.rank(); ++r) first += values[std::size_t(r)];
  Hdf5Part<double> displacement, force;
  together(ranks, [&] {
    const Hdf5Input file(path);
    file.read("cells/displacement", first, length, displacement);
    file.read("cells/force", first, length, force);
  });
  check_parts(displacement, "cells/displacement", path, ranks);
  check_parts(force, "cells/force", path, ranks);
  return {std::move(nodes.values), std::move(counts.values), std::move(displacement.values),
          std::move(force.values)};
}

/// The only record of a table.
template <class Record, class Columns>
Record read_record(const Hdf5Input& file, const std::string& table, Columns columns) {
  return read_table<Record>(file, table, columns).at(0);
}

/// All but the cells.
StoredCheckpoint read_tables(const Hdf5Input& file) {
  if (file.text_attribute("program") != "cdca" || file.whole_attribute("layout") != layout)
    throw IoError("The file is no checkpoint that this version of the program can read.");
  StoredCheckpoint stored;
  std::vector<std::string> text;
  file.read("case", text);
  stored.origin = {file.text_attribute("version"), file.text_attribute("title"), text.at(0)};
  Checkpoint& c = stored.checkpoint;
  c.progress = read_record<Progress>(file, "progress", progress_columns);
  c.story = read_record<RunStory>(file, "performance", performance_columns);
  c.story.steps = read_steps(file);
  c.story.tips = read_table<TipRecord>(file, "tips", tip_columns);
  c.story.cycle_tips = read_table<TipRecord>(file, "cycle_tips", tip_columns);
  c.energy = read_record<EnergyTotals>(file, "energy", energy_columns);
  c.cracks = read_cracks(file);
  c.events = read_table<Event>(file, "events", event_columns);
  c.patches = read_table<ContactPatch>(file, "contact", patch_columns);
  return stored;
}

}  // namespace

void write_checkpoint(const fs::path& path, const Checkpoint& c, const CheckpointOrigin& origin,
                      Communicator& ranks) {
  auto draft = path;
  draft += ".tmp";
  try {
    Hdf5Output file(draft, ranks);
    file.attribute("program", std::string("cdca"));
    file.attribute("layout", layout);
    file.attribute("version", origin.version);
    file.attribute("title", origin.title);
    file.attribute("step", std::int64_t(c.progress.steps));
    file.attribute("load_factor", c.progress.load_factor);
    file.attribute("ranks", std::int64_t(ranks.size()));
    file.put("case", {origin.effective_case});
    put_table(file, "progress", std::vector{c.progress}, progress_columns);
    put_table(file, "performance", std::vector{c.story}, performance_columns);
    put_steps(file, c.story.steps);
    put_table(file, "tips", c.story.tips, tip_columns);
    put_table(file, "cycle_tips", c.story.cycle_tips, tip_columns);
    put_table(file, "energy", std::vector{c.energy}, energy_columns);
    put_cracks(file, c.cracks);
    put_table(file, "events", c.events, event_columns);
    put_table(file, "contact", c.patches, patch_columns);
    put_cells(file, c.cells);
    file.close();
  } catch (const IoError&) {
    std::error_code error;
    if (ranks.is_root()) fs::remove(draft, error);
    throw;
  }
  together(ranks, [&] {
    if (ranks.is_root()) fs::rename(draft, path);
  });
}

StoredCheckpoint read_checkpoint(const fs::path& path, Communicator& ranks) {
  StoredCheckpoint stored;
  together(ranks, [&] { stored = read_tables(Hdf5Input(path)); });
  stored.checkpoint.cells = read_cells(path, ranks);
  return stored;
}

}  // namespace cdca
