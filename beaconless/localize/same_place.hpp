// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

inline constexpr double kSamePlace_m = 0.25;
inline constexpr double kSamePlace_rad = radians(8.0);

/// Whether two poses of a scan on the map are so near that they are the same answer to where it was taken.
inline bool is_same_place(const Pose2& a, const Pose2& b) {
  return distance_m(a, b) < kSamePlace_m && heading_difference_rad(a, b) < kSamePlace_rad;
}

}  // namespace beaconless
