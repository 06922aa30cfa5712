// SPDX-License-Identifier: BSD-3-Clause
#include "io/csv_tables.hpp"

#include <fmt/format.h>

namespace cdca {
namespace {

/// Text with commas or quotes in it goes between quotes, as spreadsheets expect.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string field(double value) { return fmt::format("{}", value); }
std::string field(int value) { return fmt::format("{}", value); }

std::string header_line(const std::vector<TableCell>& row) {
  std::string line;
  for (const TableCell& cell : row) line += (line.empty() ? "" : ",") + field(cell.column);
  return line + "\n";
}

std::string line_of(const std::vector<TableCell>& row) {
  std::string line;
  for (const TableCell& cell : row) {
    if (&cell != &row.front()) line += ",";
    line += std::visit([](const auto& value) { return field(value); }, cell.value);
  }
  return line + "\n";
}

}  // namespace

std::vector<TableCell> history_row(const std::vector<std::string>& reaction_names,
                                   const StepRecord& record) {
  std::vector<TableCell> row{{"step", record.step}, {"load_factor", record.load_factor}};
  for (std::size_t r = 0; r < reaction_names.size(); ++r) {
    row.push_back({"reaction_x_" + reaction_names[r], record.reactions.at(r)[0]});
    row.push_back({"reaction_y_" + reaction_names[r], record.reactions.at(r)[1]});
  }
  row.push_back({"strain_energy", record.strain_energy});
  row.push_back({"crack_length", record.crack_length});
  row.push_back({"active_tips", record.active_tips});
  row.push_back({"growth_cycles", record.growth_cycles});
  row.push_back({"solver_iterations", record.solver_iterations});
  row.push_back({"wall_s", record.wall_s});
  row.push_back({"external_work", record.external_work});
  row.push_back({"dissipated", record.dissipated});
  row.push_back({"friction_work", record.friction_work});
  row.push_back({"contact_iterations", record.contact_iterations});
  row.push_back({"contact_unbalanced", record.contact_unbalanced});
  return row;
}

std::vector<TableCell> tip_row(const TipRecord& record) {
  return {{"step", record.step},        {"cycle", record.cycle},
          {"crack", record.crack},      {"end", record.end},
          {"x", record.at.x()},         {"y", record.at.y()},
          {"K_I", record.k1},           {"K_II", record.k2},
          {"K_from", record.k_from},    {"U_tension", record.u_tension},
          {"U_shear", record.u_shear},  {"angle_deg", record.angle_deg},
          {"mode", record.mode},        {"growth", record.growth},
          {"K_radius", record.k_radius}};
}

std::string history_csv(const Summary& summary) {
  StepRecord blank;
  blank.reactions.resize(summary.reaction_names.size());
  std::string text = header_line(history_row(summary.reaction_names, blank));
  for (const StepRecord& record : summary.steps)
    text += line_of(history_row(summary.reaction_names, record));
  return text;
}

std::string tips_csv_header() { return header_line(tip_row({})); }

std::string tips_csv_rows(const std::vector<TipRecord>& tips) {
  std::string text;
  for (const TipRecord& tip : tips) text += line_of(tip_row(tip));
  return text;
}

}  // namespace cdca
