// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/result.hpp"

namespace beaconless::io {

/// A file of the system's temporary folder that is gone with the last who holds it.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string path) : path_(std::move(path)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD";

/// Unpacks a file that was compressed with zstd into a temporary one, a block at a time.
///
/// `room_bytes` is what the unpacked file may take, by default nine tenths of what is free in the temporary
/// folder. Errors: damaged or cut data, a window of more than 128 MB, more than the room (TMPDIR names
/// another folder), an absurd packing. Cost: the disk space of the
/// unpacked file, memory of the window only.
Result<std::shared_ptr<const TemporaryFile>> unpack_zstd_file(
    const std::string& path, std::optional<std::uint64_t> room_bytes = std::nullopt);

/// What the first bytes of such a file unpack to, `size` at most; fewer where it is damaged.
std::string unpacked_zstd_head(std::string_view packed, std::size_t size);

/// Unpacks bytes that tell their unpacked size; false where they are damaged or would be more than `limit`.
bool unpack_zstd(std::span<const unsigned char> packed, std::size_t limit, std::vector<unsigned char>& out);

}  // namespace beaconless::io
