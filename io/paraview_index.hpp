// SPDX-License-Identifier: BSD-3-Clause
/// What ParaView opens: the list of steps (.pvd) and, for every step, the list of its pieces
/// (.pvtu).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace cdca {

/// One array of values in our ParaView files.
struct ResultArray {
  std::string name;
  std::string type;                     ///< "Float64", "Int32" or "Int64"
  bool on_points = false;               ///< at points; otherwise in cells
  std::vector<std::string> components;  ///< their names; none for a plain number
};

/// The arrays of fields.pvd and of cracks.pvd, in the order in which they are written.
const std::vector<ResultArray>& field_arrays();
const std::vector<ResultArray>& crack_arrays();

/// Number of components of an array in the files; displacement has a third, zero.
int component_count(const ResultArray& array);

/// "step_0007.pvtu", "step_0007_0003.vtu": names below the folder of a series.
std::string step_file(int step);
std::string piece_file(int step, int rank);

/// The text of a .pvtu that joins the pieces of all ranks; they lie in the same folder.
std::string pvtu_text(const std::vector<ResultArray>& arrays, int step, int ranks);

/// A time series NAME.pvd over NAME/step_*.pvtu, which grows step by step.
class ParaviewSeries {
 public:
  ParaviewSeries(std::filesystem::path directory, std::string name,
                 const std::vector<ResultArray>& arrays);

  std::filesystem::path folder() const { return directory_ / name_; }
  std::filesystem::path piece(int step, int rank) const;

  /// Begins with the steps of an earlier run, as far as their files are there, and removes the
  /// files of all other steps. Throws IoError.
  void begin(const std::vector<std::pair<int, double>>& earlier);

  /// Lists a step whose pieces are all written, and rewrites the index. Throws IoError.
  void add(int step, double load_factor, int ranks);

 private:
  std::string pvd_text() const;

  std::filesystem::path directory_;
  std::string name_;
  const std::vector<ResultArray>& arrays_;
  std::vector<std::pair<int, double>> steps_;
};

}  // namespace cdca
