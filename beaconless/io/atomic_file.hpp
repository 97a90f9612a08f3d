// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "beaconless/core/result.hpp"

namespace beaconless::io {

/// Writes a file so that at every moment, a loss of power included, the old one or the new one is there
/// whole.
///
/// The bytes go to `path`.part beside it, to the disk, and then take its name. Errors: the reason of the
/// operating system; the old file is still there then. Cost: waits for the disk.
Result<Done> write_file_atomically(const std::string& path, std::string_view bytes);

}  // namespace beaconless::io
