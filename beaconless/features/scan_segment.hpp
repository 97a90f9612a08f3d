// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace beaconless {

/// Consecutive beams of a scan that belong together; all of them are hits.
///
/// On a full circle a segment may run over the end of the arrays: its beams are (first + k) % scan.size(),
/// k < count.
struct ScanSegment {
  std::size_t first = 0;
  std::size_t count = 0;

  std::size_t beam(std::size_t k, std::size_t scan_size) const {
    const std::size_t at = first + k;
    return at < scan_size ? at : at - scan_size;
  }

  friend bool operator==(const ScanSegment&, const ScanSegment&) = default;
};

}  // namespace beaconless
