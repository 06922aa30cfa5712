// SPDX-License-Identifier: BSD-3-Clause
#include "io/checksum.hpp"

#include <vector>
#include <zlib.h>

namespace cdca {

std::uint32_t checksum(std::span<const std::byte> bytes) {
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  return std::uint32_t(crc32_z(crc32_z(0, nullptr, 0), data, bytes.size()));
}

std::uint32_t joint_checksum(std::uint32_t mine, std::int64_t bytes, Communicator& ranks) {
  std::vector<std::int64_t> all(2 * std::size_t(ranks.size()), 0);
  const auto at = 2 * std::size_t(ranks.rank());
  all[at] = mine;
  all[at + 1] = bytes;
  ranks.sum(std::span<std::int64_t>(all));
  auto joint = crc32_z(0, nullptr, 0);
  for (std::size_t k = 0; k < all.size(); k += 2)
    joint = crc32_combine(joint, static_cast<uLong>(all[k]), static_cast<z_off_t>(all[k + 1]));
  return std::uint32_t(joint);
}

}  // namespace cdca
