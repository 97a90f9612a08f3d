// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace beaconless::trust {

/// How often poses were right, by the quality that they were given: bins of a tenth, the last one with its
/// end.
struct ReliabilityBins {
  static constexpr std::size_t kBins = 10;

  std::array<std::size_t, kBins> count{};
  std::array<std::size_t, kBins> right{};

  void add(double quality, bool is_right) {
    const auto bin = static_cast<std::size_t>(std::clamp(quality, 0.0, 1.0) * kBins);
    const std::size_t last = std::min(bin, kBins - 1);
    ++count[last];
    right[last] += is_right ? 1 : 0;
  }
};

/// How large protection levels were, in steps of a tenth of a decade from a millimetre on.
struct LevelBins {
  static constexpr std::size_t kBins = 60;

  std::array<std::size_t, kBins> count{};

  void add(double level_m);
};

}  // namespace beaconless::trust
