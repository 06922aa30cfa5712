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

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw IoError("Cannot remove the old " + file.string() + ": " + error.message() + ".");
}

bool is_step_file(const fs::path& file) {
  return file.filename().string().starts_with("step_") &&
         (file.extension() == ".vtu" || file.extension() == ".pvtu");
}

void remove_step_files(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_step_file(entry.path())) found.push_back(entry.path());
  std::for_each(found.begin(), found.end(), remove_file);
}

}  // namespace

ResultWriter::ResultWriter(fs::path directory, int every, Communicator& comm,
                           std::string effective_case)
    : directory_(std::move(directory)),
      every_(std::max(every, 1)),
      comm_(comm),
      effective_case_(std::move(effective_case)),
      fields_(directory_, "fields", field_arrays()),
      cracks_(directory_, "cracks", crack_arrays()) {
  together(comm_, [&] {
    if (comm_.is_root()) make_folder(directory_);
  });
}

void ResultWriter::on_start(const Summary& summary) {
  together(comm_, [&] {
    if (!comm_.is_root()) return;
    for (const char* name : old_files) remove_file(directory_ / name);
    for (const auto& folder : {fields_.folder(), cracks_.folder()}) {
      make_folder(folder);
      remove_step_files(folder);
    }
    if (!effective_case_.empty()) write_text(directory_ / "effective.toml", effective_case_);
    write_text(directory_ / "tips.csv", tips_csv_header());
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
