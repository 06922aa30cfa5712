// SPDX-License-Identifier: BSD-3-Clause
/// Lists of plain records as tables of an HDF5 file: a group per list, an array per column. A list
/// of columns is a function that calls visit(name, unit, member) for each of them, where member
/// gives the value in a record: it serves for writing and for reading.
#pragma once

#include "core/base/errors.hpp"
#include "core/base/types.hpp"
#include "io/hdf5_file.hpp"

#include <string>
#include <type_traits>
#include <vector>

namespace cdca {

/// Collective, with the same records on every rank.
template <class Record, class Columns>
void put_table(Hdf5Output& file, const std::string& table, const std::vector<Record>& records,
               Columns columns) {
  columns([&](const char* column, const char* unit, auto member) {
    using Value = std::decay_t<decltype(member(records.front()))>;
    const std::string name = table + "/" + column;
    if constexpr (std::is_same_v<Value, std::string>) {
      std::vector<std::string> texts;
      for (const Record& record : records) texts.push_back(member(record));
      file.put(name, texts);
    } else if constexpr (std::is_same_v<Value, Vec2>) {
      std::vector<double> values;
      for (const Record& record : records)
        values.insert(values.end(), {member(record).x(), member(record).y()});
      file.put(name, unit, values, 2);
    } else if constexpr (std::is_floating_point_v<Value>) {
      std::vector<double> values;
      for (const Record& record : records) values.push_back(member(record));
      file.put(name, unit, values);
    } else {
      std::vector<std::int64_t> values;
      for (const Record& record : records)
        values.push_back(static_cast<std::int64_t>(member(record)));
      file.put(name, unit, values);
    }
  });
}

/// Throws IoError where columns are missing or not of one length.
template <class Record, class Columns>
std::vector<Record> read_table(const Hdf5Input& file, const std::string& table, Columns columns) {
  std::vector<Record> records;
  bool first = true;
  const auto fit = [&](std::size_t rows) {
    if (first) records.resize(rows);
    first = false;
    if (records.size() != rows)
      throw IoError("The checkpoint is damaged: the columns of " + table + " differ in length.");
  };
  columns([&](const char* column, const char*, auto member) {
    using Value = std::decay_t<decltype(member(std::declval<Record&>()))>;
    const std::string name = table + "/" + column;
    if constexpr (std::is_same_v<Value, std::string>) {
      std::vector<std::string> texts;
      file.read(name, texts);
      fit(texts.size());
      for (std::size_t k = 0; k < texts.size(); ++k) member(records[k]) = texts[k];
    } else if constexpr (std::is_same_v<Value, Vec2>) {
      std::vector<double> values;
      file.read(name, values);
      fit(values.size() / 2);
      for (std::size_t k = 0; k < records.size(); ++k)
        member(records[k]) = Vec2(values[2 * k], values[2 * k + 1]);
    } else if constexpr (std::is_floating_point_v<Value>) {
      std::vector<double> values;
      file.read(name, values);
      fit(values.size());
      for (std::size_t k = 0; k < values.size(); ++k) member(records[k]) = values[k];
    } else {
      std::vector<std::int64_t> values;
      file.read(name, values);
      fit(values.size());
      for (std::size_t k = 0; k < values.size(); ++k)
        member(records[k]) = static_cast<Value>(values[k]);
    }
  });
  return records;
}

}  // namespace cdca
