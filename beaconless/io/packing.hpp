// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// Plain C++17: librosbag and what it includes are built as that.
namespace beaconless::io {

/// Whether so few bytes that unpack to so many hold anything but a wish to fill memory, a disk or an hour:
/// over 16 MiB and a thousand times as much. Recordings pack to a half or a tenth.
constexpr bool is_absurd_packing(std::uint64_t packed_bytes, std::uint64_t plain_bytes) {
  return plain_bytes > 16U << 20U && plain_bytes / 1000 > packed_bytes;
}

}  // namespace beaconless::io
