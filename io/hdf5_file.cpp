// SPDX-License-Identifier: BSD-3-Clause
#include "io/hdf5_file.hpp"

#include "core/base/errors.hpp"
#include "core/base/first_failure.hpp"
#include "io/checksum.hpp"

#include <hdf5.h>
#include <mpi.h>

#include <algorithm>
#include <utility>

#ifndef H5_HAVE_PARALLEL
#error "This HDF5 was built without MPI; needed is a parallel one, as of libhdf5-openmpi-dev."
#endif

namespace cdca {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

/// An HDF5 object, closed at the end of its scope.
class Object {
 public:
  Object(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Object() {
    if (id_ >= 0) close_(id_);
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// HDF5 prints what goes wrong on its own; we tell it ourselves.
void be_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// What HDF5 says of its last failure, from the innermost call.
std::string reason() {
  std::string text = "unknown reason";
  const auto take = [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
    if (error->desc) *static_cast<std::string*>(out) = error->desc;
    return 1;  // the first is enough
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take, &text);
  return text;
}

Object text_type(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, std::max<std::size_t>(length, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return {type, H5Tclose};
}

herr_t set_attribute(hid_t object, const std::string& name, hid_t type, const void* value) {
  const Object space(H5Screate(H5S_SCALAR), H5Sclose);
  const Object attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  return H5Awrite(attribute, type, value);
}

herr_t set_text(hid_t object, const std::string& name, const std::string& text) {
  // an empty text still takes a byte, which c_str() has
  return set_attribute(object, name, text_type(text.size()), text.c_str());
}

}  // namespace

/// The rows of an array: how many there are, and which of them this rank writes.
struct Hdf5Output::Rows {
  hsize_t total = 0;
  hsize_t first = 0;
  hsize_t count = 0;
  hsize_t width = 1;
  std::uint32_t checksum = 0;  ///< of all rows
};

Hdf5Output::Hdf5Output(const std::filesystem::path& file, Communicator& ranks)
    : path_(file), ranks_(ranks) {
  be_quiet();
  const Object access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // the oldest layout whose own data are all checksummed
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  if (ranks_.size() > 1) H5Pset_fapl_mpio(access, MPI_COMM_WORLD, MPI_INFO_NULL);
  file_ = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  check(file_, "the file cannot be made");
}

Hdf5Output::~Hdf5Output() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Output::check(std::int64_t status, const std::string& what) {
  if (status < 0 && failure_.empty())
    failure_ = "Cannot write " + path_.string() + ": " + what + ": " + reason() + ".";
}

void Hdf5Output::attribute(const std::string& name, const std::string& text) {
  check(set_text(file_, name, text), name);
}

void Hdf5Output::attribute(const std::string& name, std::int64_t value) {
  check(set_attribute(file_, name, H5T_NATIVE_INT64, &value), name);
}

void Hdf5Output::attribute(const std::string& name, double value) {
  check(set_attribute(file_, name, H5T_NATIVE_DOUBLE, &value), name);
}

void Hdf5Output::write(const std::string& name, std::string_view unit, std::int64_t type,
                       const void* data, const Rows& rows) {
  const hsize_t size[2] = {rows.total, rows.width};
  const hsize_t first[2] = {rows.first, 0}, count[2] = {rows.count, rows.width};
  const int axes = rows.width > 1 ? 2 : 1;
  const Object links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  const Object space(H5Screate_simple(axes, size, nullptr), H5Sclose);
  const Object set(H5Dcreate2(file_, name.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  check(set, name);
  const Object memory(H5Screate_simple(axes, count, nullptr), H5Sclose);
  if (rows.count > 0) {
    H5Sselect_hyperslab(space, H5S_SELECT_SET, first, nullptr, count, nullptr);
  } else {
    H5Sselect_none(space);
    H5Sselect_none(memory);
  }
  const Object transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  if (ranks_.size() > 1) H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
  // an array without values has no place in the file
  if (rows.total > 0) check(H5Dwrite(set, type, memory, space, transfer, data), name);
  if (!unit.empty()) check(set_text(set, "unit", std::string(unit)), name);
  check(set_attribute(set, "crc32", H5T_NATIVE_UINT32, &rows.checksum), name);
}

namespace {

/// Of what the root has.
std::uint32_t root_checksum(std::span<const std::byte> bytes, Communicator& ranks) {
  return std::uint32_t(ranks.sum(ranks.is_root() ? std::int64_t(checksum(bytes)) : 0));
}

}  // namespace

void Hdf5Output::put(const std::string& name, std::string_view unit, std::span<const double> values,
                     std::size_t width) {
  const hsize_t total = values.size() / width;
  write(name, unit, H5T_NATIVE_DOUBLE, values.data(),
        {total, 0, ranks_.is_root() ? total : 0, width,
         root_checksum(std::as_bytes(values), ranks_)});
}

void Hdf5Output::put(const std::string& name, std::string_view unit,
                     std::span<const std::int64_t> values) {
  const hsize_t total = values.size();
  write(name, unit, H5T_NATIVE_INT64, values.data(),
        {total, 0, ranks_.is_root() ? total : 0, 1, root_checksum(std::as_bytes(values), ranks_)});
}

void Hdf5Output::put(const std::string& name, const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const auto& text : texts) length = std::max(length, text.size());
  std::string all;
  for (const auto& text : texts) all += text + std::string(length - text.size(), '\0');
  const hsize_t total = texts.size();
  write(name, "", text_type(length), all.data(),
        {total, 0, ranks_.is_root() ? total : 0, 1,
         root_checksum(std::as_bytes(std::span(all)), ranks_)});
}

namespace {

/// Where this rank's part begins, and the size of the whole.
std::pair<std::int64_t, std::int64_t> place_of(std::int64_t mine, Communicator& ranks) {
  std::vector<std::int64_t> counts(std::size_t(ranks.size()), 0);
  counts[std::size_t(ranks.rank())] = mine;
  ranks.sum(std::span<std::int64_t>(counts));
  std::int64_t first = 0, total = 0;
  for (int r = 0; r < ranks.size(); ++r) {
    if (r < ranks.rank()) first += counts[std::size_t(r)];
    total += counts[std::size_t(r)];
  }
  return {first, total};
}

}  // namespace

void Hdf5Output::put_parts(const std::string& name, std::string_view unit,
                           std::span<const double> mine) {
  const auto [first, total] = place_of(std::int64_t(mine.size()), ranks_);
  const auto sum =
      joint_checksum(checksum(std::as_bytes(mine)), std::int64_t(mine.size_bytes()), ranks_);
  write(name, unit, H5T_NATIVE_DOUBLE, mine.data(),
        {hsize_t(total), hsize_t(first), mine.size(), 1, sum});
}

void Hdf5Output::put_parts(const std::string& name, std::string_view unit,
                           std::span<const std::int64_t> mine) {
  const auto [first, total] = place_of(std::int64_t(mine.size()), ranks_);
  const auto sum =
      joint_checksum(checksum(std::as_bytes(mine)), std::int64_t(mine.size_bytes()), ranks_);
  write(name, unit, H5T_NATIVE_INT64, mine.data(),
        {hsize_t(total), hsize_t(first), mine.size(), 1, sum});
}

void Hdf5Output::close() {
  const hid_t file = std::exchange(file_, -1);
  if (file >= 0) check(H5Fclose(file), "the file cannot be closed");
  const std::string first = first_failure(ranks_, failure_);
  if (!first.empty()) throw IoError(first);
}

Hdf5Input::Hdf5Input(const std::filesystem::path& file) : path_(file) {
  be_quiet();
  file_ = check(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "it is no whole HDF5 file");
}

Hdf5Input::~Hdf5Input() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Input::fail(const std::string& what) const {
  throw IoError("Cannot read " + path_.string() + ": " + what + ".");
}

std::int64_t Hdf5Input::check(std::int64_t status, const std::string& what) const {
  if (status < 0) fail(what + " (" + reason() + ")");
  return status;
}

std::string Hdf5Input::text_attribute(const std::string& name) const {
  const Object attribute(H5Aopen(file_, name.c_str(), H5P_DEFAULT), H5Aclose);
  check(attribute, name);
  const Object type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) fail(name + " is no text");
  std::string text(H5Tget_size(type), '\0');
  check(H5Aread(attribute, type, text.data()), name);
  return text.substr(0, text.find('\0'));
}

std::int64_t Hdf5Input::whole_attribute(const std::string& name) const {
  const Object attribute(H5Aopen(file_, name.c_str(), H5P_DEFAULT), H5Aclose);
  check(attribute, name);
  std::int64_t value = 0;
  check(H5Aread(attribute, H5T_NATIVE_INT64, &value), name);
  return value;
}

namespace {

hssize_t values_in(hid_t set) {
  const Object space(H5Dget_space(set), H5Sclose);
  return H5Sget_simple_extent_npoints(space);
}

/// -1 where there is none.
std::int64_t stored_checksum(hid_t set) {
  const Object attribute(H5Aopen(set, "crc32", H5P_DEFAULT), H5Aclose);
  std::int64_t value = 0;
  return attribute >= 0 && H5Aread(attribute, H5T_NATIVE_INT64, &value) >= 0 ? value : -1;
}

}  // namespace

std::int64_t Hdf5Input::size(const std::string& name) const {
  const Object set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  check(set, name);
  return check(values_in(set), name);
}

template <class T>
void Hdf5Input::read_whole(const std::string& name, std::int64_t type,
                           std::vector<T>& values) const {
  const Object set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  check(set, name);
  values.resize(std::size_t(check(values_in(set), name)));
  check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  if (stored_checksum(set) != checksum(std::as_bytes(std::span(values))))
    fail("the checksum of " + name + " is wrong");
}

template <class T>
void Hdf5Input::read_part(const std::string& name, std::int64_t type, std::int64_t first,
                          std::int64_t count, Hdf5Part<T>& part) const {
  const Object set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  check(set, name);
  const Object space(H5Dget_space(set), H5Sclose);
  const hsize_t from = hsize_t(first), rows = hsize_t(count);
  const Object memory(H5Screate_simple(1, &rows, nullptr), H5Sclose);
  part.values.resize(std::size_t(count));
  if (count > 0) {
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &from, nullptr, &rows, nullptr), name);
    check(H5Dread(set, type, memory, space, H5P_DEFAULT, part.values.data()), name);
  }
  part.checksum = checksum(std::as_bytes(std::span(part.values)));
  part.expected = std::uint32_t(check(stored_checksum(set), "there is no checksum of " + name));
}

void Hdf5Input::read(const std::string& name, std::vector<double>& values) const {
  read_whole(name, H5T_NATIVE_DOUBLE, values);
}

void Hdf5Input::read(const std::string& name, std::vector<std::int64_t>& values) const {
  read_whole(name, H5T_NATIVE_INT64, values);
}

void Hdf5Input::read(const std::string& name, std::vector<std::string>& texts) const {
  const Object set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  check(set, name);
  const Object type(H5Dget_type(set), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) fail(name + " is no text");
  const std::size_t length = H5Tget_size(type);
  const auto count = std::size_t(check(values_in(set), name));
  std::string all(count * length, '\0');
  check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), name);
  if (stored_checksum(set) != checksum(std::as_bytes(std::span(all))))
    fail("the checksum of " + name + " is wrong");
  texts.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const std::string text = all.substr(k * length, length);
    texts.push_back(text.substr(0, text.find('\0')));
  }
}

void Hdf5Input::read(const std::string& name, std::int64_t first, std::int64_t count,
                     Hdf5Part<double>& part) const {
  read_part(name, H5T_NATIVE_DOUBLE, first, count, part);
}

void Hdf5Input::read(const std::string& name, std::int64_t first, std::int64_t count,
                     Hdf5Part<std::int64_t>& part) const {
  read_part(name, H5T_NATIVE_INT64, first, count, part);
}

}  // namespace cdca
