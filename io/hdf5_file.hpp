// SPDX-License-Identifier: BSD-3-Clause
/// HDF5 files of arrays with names, units and checksums. Only the .cpp beside this file knows
/// hdf5.h.
#pragma once

#include "core/base/communicator.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cdca {

/// A new file, which all ranks write together: every call is collective. Arrays are called
/// "group/name". What goes wrong is told by close(), on all ranks; until then calls do what they
/// can, so that no rank waits for another.
class Hdf5Output {
 public:
  Hdf5Output(const std::filesystem::path& file, Communicator& ranks);
  ~Hdf5Output();
  Hdf5Output(const Hdf5Output&) = delete;
  Hdf5Output& operator=(const Hdf5Output&) = delete;

  /// Of the file as a whole.
  void attribute(const std::string& name, const std::string& text);
  void attribute(const std::string& name, std::int64_t value);
  void attribute(const std::string& name, double value);

  /// An array that every rank has; that of the root is written, in rows of `width` values. Sizes
  /// and texts must be the same on all ranks.
  void put(const std::string& name, std::string_view unit, std::span<const double> values,
           std::size_t width = 1);
  void put(const std::string& name, std::string_view unit, std::span<const std::int64_t> values);
  void put(const std::string& name, const std::vector<std::string>& texts);
  /// An array whose parts lie on the ranks; they are written one after the other.
  void put_parts(const std::string& name, std::string_view unit, std::span<const double> mine);
  void put_parts(const std::string& name, std::string_view unit,
                 std::span<const std::int64_t> mine);

  /// Throws IoError on all ranks when any of them failed at anything.
  void close();

 private:
  struct Rows;
  void write(const std::string& name, std::string_view unit, std::int64_t type, const void* data,
             const Rows& rows);
  void check(std::int64_t status, const std::string& what);

  std::filesystem::path path_;
  Communicator& ranks_;
  std::int64_t file_ = -1;
  std::string failure_;  ///< the first one on this rank
};

/// A part of an array, and what is needed to check the whole of it.
template <class T>
struct Hdf5Part {
  std::vector<T> values;
  std::uint32_t checksum = 0;  ///< of these values
  std::uint32_t expected = 0;  ///< of the whole array
};

/// A file to read from; each rank opens it for itself. Everything throws IoError where the file is
/// damaged or has not what is asked for; whole arrays are checked against their checksums.
class Hdf5Input {
 public:
  explicit Hdf5Input(const std::filesystem::path& file);
  ~Hdf5Input();
  Hdf5Input(const Hdf5Input&) = delete;
  Hdf5Input& operator=(const Hdf5Input&) = delete;

  std::string text_attribute(const std::string& name) const;
  std::int64_t whole_attribute(const std::string& name) const;

  std::int64_t size(const std::string& name) const;  ///< number of values
  void read(const std::string& name, std::vector<double>& values) const;
  void read(const std::string& name, std::vector<std::int64_t>& values) const;
  void read(const std::string& name, std::vector<std::string>& texts) const;
  /// Values [first, first + count) of an array of rows of one value.
  void read(const std::string& name, std::int64_t first, std::int64_t count,
            Hdf5Part<double>& part) const;
  void read(const std::string& name, std::int64_t first, std::int64_t count,
            Hdf5Part<std::int64_t>& part) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  std::int64_t check(std::int64_t status, const std::string& what) const;
  template <class T>
  void read_whole(const std::string& name, std::int64_t type, std::vector<T>& values) const;
  template <class T>
  void read_part(const std::string& name, std::int64_t type, std::int64_t first, std::int64_t count,
                 Hdf5Part<T>& part) const;

  std::filesystem::path path_;
  std::int64_t file_ = -1;
};

}  // namespace cdca
