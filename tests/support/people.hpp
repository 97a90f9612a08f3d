// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "beaconless/core/rng.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::test {

/// Covers a share of the beams with people: bursts of 2 to 15 degrees, nearer than the walls behind.
inline RawScan among_people(RawScan raw, double share, Rng& rng) {
  const std::size_t size = raw.ranges_m.size();
  std::vector<bool> is_covered(size, false);
  std::size_t covered = 0;
  while (static_cast<double>(covered) < share * static_cast<double>(size)) {
    const auto width = static_cast<std::size_t>(rng.uniform(8.0, 60.0));
    const auto first = static_cast<std::size_t>(rng.uniform(0.0, static_cast<double>(size - width)));
    const double ahead_m = rng.uniform(0.15, 2.5);
    for (std::size_t i = first; i < first + width; ++i) {
      if (is_covered[i]) continue;
      is_covered[i] = true;
      ++covered;
      raw.ranges_m[i] = std::max(0.3F, raw.ranges_m[i] - static_cast<float>(ahead_m + rng.normal(0.02)));
    }
  }
  return raw;
}

}  // namespace beaconless::test
