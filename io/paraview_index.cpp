// SPDX-License-Identifier: BSD-3-Clause
#include "io/paraview_index.hpp"

#include "io/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>
#include <system_error>

namespace cdca {
namespace {

constexpr const char* head = "<?xml version=\"1.0\"?>\n";

std::string data_array(const ResultArray& array) {
  std::string text =
      fmt::format("      <PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", array.type,
                  array.name, component_count(array));
  for (std::size_t c = 0; c < array.components.size(); ++c)
    text += fmt::format(" ComponentName{}=\"{}\"", c, array.components[c]);
  return text + "/>\n";
}

std::string data_arrays(const std::vector<ResultArray>& arrays, bool on_points) {
  const std::string element = on_points ? "PPointData" : "PCellData";
  std::string text = "    <" + element + ">\n";
  for (const ResultArray& array : arrays)
    if (array.on_points == on_points) text += data_array(array);
  return text + "    </" + element + ">\n";
}

/// The number in "step_0007.pvtu" and "step_0007_0003.vtu"; none for other files.
std::optional<int> step_in(const std::filesystem::path& file) {
  constexpr std::string_view prefix = "step_";
  const auto name = file.filename().string();
  const bool is_ours =
      name.starts_with(prefix) && (file.extension() == ".vtu" || file.extension() == ".pvtu");
  int number = 0;
  const char* end = name.data() + name.size();
  const bool has_number =
      is_ours && std::from_chars(name.data() + prefix.size(), end, number).ec == std::errc();
  return has_number ? std::optional(number) : std::nullopt;
}

}  // namespace

const std::vector<ResultArray>& field_arrays() {
  static const std::vector<ResultArray> arrays{
      {"displacement", "Float64", true, {"x", "y", "z"}},
      {"stress", "Float64", false, {"xx", "yy", "zz", "xy"}},
      {"principal_stress", "Float64", false, {"larger", "smaller"}},
      {"young", "Float64", false, {}},
      {"kind", "Int32", false, {}},
      {"pieces", "Int32", false, {}},
      {"owner", "Int32", false, {}},
      {"element", "Int64", false, {}},
  };
  return arrays;
}

const std::vector<ResultArray>& crack_arrays() {
  static const std::vector<ResultArray> arrays{
      {"opening", "Float64", true, {}},
      {"slip", "Float64", true, {}},
      {"crack", "Int32", false, {}},
      {"age", "Int32", false, {}},
      {"contact_state", "Int32", false, {}},
      {"normal_traction", "Float64", false, {}},
      {"tangential_traction", "Float64", false, {}},
  };
  return arrays;
}

int component_count(const ResultArray& array) {
  return array.components.empty() ? 1 : static_cast<int>(array.components.size());
}

std::string step_file(int step) { return fmt::format("step_{:04}.pvtu", step); }

std::string piece_file(int step, int rank) {
  return fmt::format("step_{:04}_{:04}.vtu", step, rank);
}

std::string pvtu_text(const std::vector<ResultArray>& arrays, int step, int ranks) {
  std::string text = head;
  text +=
      "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n  <PUnstructuredGrid GhostLevel=\"0\">\n";
  text += data_arrays(arrays, true) + data_arrays(arrays, false);
  text +=
      "    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" "
      "NumberOfComponents=\"3\"/>\n"
      "    </PPoints>\n";
  for (int rank = 0; rank < ranks; ++rank)
    text += fmt::format("    <Piece Source=\"{}\"/>\n", piece_file(step, rank));
  return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

ParaviewSeries::ParaviewSeries(std::filesystem::path directory, std::string name,
                               const std::vector<ResultArray>& arrays)
    : directory_(std::move(directory)), name_(std::move(name)), arrays_(arrays) {}

std::filesystem::path ParaviewSeries::piece(int step, int rank) const {
  return folder() / piece_file(step, rank);
}

void ParaviewSeries::begin(const std::vector<std::pair<int, double>>& earlier) {
  steps_.clear();
  for (const auto& step : earlier)
    if (std::filesystem::exists(folder() / step_file(step.first))) steps_.push_back(step);
  std::error_code error;
  std::vector<std::filesystem::path> others;
  for (const auto& entry : std::filesystem::directory_iterator(folder(), error)) {
    const auto number = step_in(entry.path());
    const bool is_known =
        std::any_of(steps_.begin(), steps_.end(), [&](auto& step) { return step.first == number; });
    if (number && !is_known) others.push_back(entry.path());
  }
  for (const auto& file : others) remove_old(file);
  if (!steps_.empty()) write_text(directory_ / (name_ + ".pvd"), pvd_text());
}

void ParaviewSeries::add(int step, double load_factor, int ranks) {
  write_text(folder() / step_file(step), pvtu_text(arrays_, step, ranks));
  steps_.emplace_back(step, load_factor);
  write_text(directory_ / (name_ + ".pvd"), pvd_text());
}

std::string ParaviewSeries::pvd_text() const {
  // ParaView needs times that grow; a load that goes down again (snap-back) is shown by step.
  const bool by_load = std::adjacent_find(steps_.begin(), steps_.end(), [](auto& a, auto& b) {
                         return !(a.second < b.second);
                       }) == steps_.end();
  std::string text = head;
  text +=
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const auto& [step, load_factor] : steps_)
    text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}/{}\"/>\n",
                        by_load ? load_factor : step, name_, step_file(step));
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace cdca
