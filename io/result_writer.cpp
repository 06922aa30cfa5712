// SPDX-License-Identifier: BSD-3-Clause
#include "io/result_writer.hpp"

#include "core/base/errors.hpp"
#include "io/csv_tables.hpp"
#include "io/summary_json.hpp"
#include "io/text_file.hpp"
#include "io/vtk_writer.hpp"
#include "parallel/together.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

namespace cdca {
namespace {

namespace fs = std::filesystem;

constexpr std::array old_files{"summary.json",   "history.csv",     "tips.csv",
                               "effective.toml", "fields.pvd",      "cracks.pvd",
                               "opened.png",     "crack_paths.png", "load_displacement.png"};

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error))
    throw IoError("Cannot make the result folder " + folder.string() + ": " +
                  (error ? error.message() : "a file of that name is in the way") + ".");
}

/// The rows of tips.csv that belong to steps up to `last`; the step stands first in a row. What a
/// broken write left of a row is none.
std::string rows_up_to(int last, const fs::path& table) {
  std::ifstream file(table, std::ios::binary);
  std::string rows = tips_csv_header(), row;
  for (bool is_head = true; std::getline(file, row) && !file.eof(); is_head = false) {
    if (!is_head && std::atoi(row.c_str()) <= last) rows += row + '\n';
  }
  return rows;
}

}  // namespace

ResultWriter::ResultWriter(fs::path directory, int every, Communicator& comm,
                           std::string effective_case, std::optional<fs::path> continued)
    : directory_(std::move(directory)),
      every_(std::max(every, 1)),
      comm_(comm),
      effective_case_(std::move(effective_case)),
      continued_(std::move(continued)),
      fields_(directory_, "fields", field_arrays()),
      cracks_(directory_, "cracks", crack_arrays()) {
  together(comm_, [&] {
    if (comm_.is_root()) make_folder(directory_);
  });
}

void ResultWriter::on_start(const Summary& summary) {
  together(comm_, [&] {
    if (!comm_.is_root()) return;
    const int last = summary.steps.empty() ? 0 : summary.steps.back().step;
    std::string rows = tips_csv_header();
    std::vector<std::pair<int, double>> earlier;
    if (continued_) rows = rows_up_to(last, *continued_ / "tips.csv");
    std::error_code error;
    if (continued_ && fs::equivalent(*continued_, directory_, error)) {
      for (const StepRecord& step : summary.steps)
        earlier.emplace_back(step.step, step.load_factor);
    } else {
      for (const char* name : old_files) remove_old(directory_ / name);
    }
    for (auto* series : {&fields_, &cracks_}) {
      make_folder(series->folder());
      series->begin(earlier);
    }
    if (!effective_case_.empty()) write_text(directory_ / "effective.toml", effective_case_);
    write_text(directory_ / "tips.csv", rows);
    write_tables(summary);
  });
}

void ResultWriter::on_step(const StepView& view) {
  const int step = view.summary.steps.back().step;
  if (view.last || step % every_ == 0) write_paraview(view);
  together(comm_, [&] {
    if (!comm_.is_root()) return;
    append_text(directory_ / "tips.csv", tips_csv_rows(view.cycle_tips));
    write_tables(view.summary);
  });
}

void ResultWriter::on_finish(const Summary& summary) {
  together(comm_, [&] {
    if (comm_.is_root()) write_tables(summary);
  });
}

void ResultWriter::write_tables(const Summary& summary) const {
  write_text(directory_ / "history.csv", history_csv(summary));
  write_text(directory_ / "summary.json", summary_json(summary));
}

void ResultWriter::write_paraview(const StepView& view) {
  const StepRecord& record = view.summary.steps.back();
  // Parts are computed by all ranks together, so outside of together().
  const FieldPart fields = view.fields();
  const CrackPart cracks = view.cracks();
  together(comm_, [&] {
    write_vtu(fields_.piece(record.step, comm_.rank()), fields);
    write_vtu(cracks_.piece(record.step, comm_.rank()), cracks);
  });
  together(comm_, [&] {
    if (!comm_.is_root()) return;
    fields_.add(record.step, record.load_factor, comm_.size());
    cracks_.add(record.step, record.load_factor, comm_.size());
  });
}

}  // namespace cdca
