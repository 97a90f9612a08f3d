// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "beaconless/core/result.hpp"

namespace beaconless::io {

/// The bytes of a regular file, or how many there are: the two questions that every reader asks first.
///
/// Errors: no such file, a directory or another thing that is no regular file, not allowed to read.
Result<std::uint64_t> file_size_bytes(const std::string& path);

/// Reads a regular file of at most `max_bytes`; a larger one is refused before anything is allocated.
Result<std::string> read_whole_file(const std::string& path, std::uint64_t max_bytes);

/// Writes a file, replacing what was there. Errors: the reason of the operating system.
Result<Done> write_whole_file(const std::string& path, std::string_view bytes);

}  // namespace beaconless::io
