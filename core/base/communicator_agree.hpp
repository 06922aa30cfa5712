// SPDX-License-Identifier: BSD-3-Clause
/// The body of Communicator::agree, and how records become bytes.
#pragma once

#include "core/base/communicator.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <vector>

namespace cdca {

/// Appends the bytes of trivially copyable values.
template <class T>
void pack(Bytes& bytes, std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto start = bytes.size();
  bytes.resize(start + values.size_bytes());
  if (!values.empty()) std::memcpy(bytes.data() + start, values.data(), values.size_bytes());
}

/// The values that pack() wrote.
template <class T>
std::vector<T> unpack(const Bytes& bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

template <class Record, class Less>
std::vector<Record> Communicator::agree(const std::vector<Record>& mine, Less less) {
  Bytes outgoing;
  pack(outgoing, std::span<const Record>(mine));
  std::vector<Record> all;
  for (const Bytes& part : gather(outgoing)) {
    const auto records = unpack<Record>(part);
    all.insert(all.end(), records.begin(), records.end());
  }
  std::stable_sort(all.begin(), all.end(), less);
  Bytes agreed;
  pack(agreed, std::span<const Record>(all));
  broadcast(agreed);
  return unpack<Record>(agreed);
}

}  // namespace cdca
