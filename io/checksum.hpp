// SPDX-License-Identifier: BSD-3-Clause
/// Checksums of arrays that lie on several ranks.
#pragma once

#include "core/base/communicator.hpp"

#include <cstdint>
#include <span>

namespace cdca {

/// CRC-32 as in zlib and PNG.
std::uint32_t checksum(std::span<const std::byte> bytes);

/// Checksum of the arrays of all ranks, one after the other: that of the whole does not depend on
/// how it is shared out. Collective.
std::uint32_t joint_checksum(std::uint32_t mine, std::int64_t bytes, Communicator& ranks);

}  // namespace cdca
