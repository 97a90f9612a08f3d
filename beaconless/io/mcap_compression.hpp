// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/result.hpp"

namespace beaconless::io {

/// How the chunks of an MCAP file are packed.
enum class McapCompression { none, lz4, zstd };

/// The word that the format has for it: "", "lz4", "zstd".
std::string_view to_string(McapCompression compression);

/// More than this a chunk may not unpack to; writers make chunks of some megabytes.
inline constexpr std::uint64_t kMaxMcapChunkBytes = std::uint64_t{256} << 20U;

/// Unpacks a chunk into `out`, replacing what was there.
///
/// `out` grows as bytes come out, never by what `unpacked_size` claims. Errors (without a place): a
/// compression that is not known, a claim above kMaxMcapChunkBytes or of an absurd packing, bytes that do not
/// unpack, or to another size.
Result<Done> unpack_mcap_chunk(std::string_view compression, std::span<const unsigned char> packed,
                               std::uint64_t unpacked_size, std::vector<unsigned char>& out);

/// Packs the records of a chunk; what unpack_mcap_chunk unpacks.
std::string pack_mcap_chunk(McapCompression compression, std::string_view records);

}  // namespace beaconless::io
