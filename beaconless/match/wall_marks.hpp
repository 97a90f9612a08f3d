// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace beaconless {

/// Beams before which a loop over them leaves its sums so far, lane by lane; what lies between two marks is
/// their difference. Begins with none.
struct WallMarks {
  static constexpr std::size_t kLanes = 4;  ///< at most
  static constexpr std::size_t kSums = 9;  ///< xx, xy, yy, xt, yt, tt of Σ w J Jᵀ / variance; then Σ w J e

  using Lanes = std::array<double, kSums * kLanes>;

  std::vector<std::uint32_t> at;  ///< ascending multiples of `width`; the last beyond all beams
  std::vector<Lanes> lanes;       ///< at least as many
  std::size_t width = kLanes;     ///< how many lanes the loop has
};

}  // namespace beaconless
