// SPDX-License-Identifier: BSD-3-Clause
/// The tables of a run as comma-separated text: history.csv and tips.csv.
#pragma once

#include "core/simulation/snapshot.hpp"

#include <string>
#include <variant>
#include <vector>

namespace cdca {

/// One named value of a row.
struct TableCell {
  std::string column;
  std::variant<int, double, std::string> value;
};

/// A row of history.csv, and of "steps" in summary.json.
std::vector<TableCell> history_row(const std::vector<std::string>& reaction_names,
                                   const StepRecord& record);

/// A row of tips.csv.
std::vector<TableCell> tip_row(const TipRecord& record);

/// All of history.csv: the header and a row per load step. Numbers read back as exactly the same.
std::string history_csv(const Summary& summary);

/// The header of tips.csv, and its rows for some tips.
std::string tips_csv_header();
std::string tips_csv_rows(const std::vector<TipRecord>& tips);

}  // namespace cdca
