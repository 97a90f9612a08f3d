// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/ray_caster.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::test {

/// A sweep of a whole turn, the first beam straight behind, with Gaussian noise on the ranges.
inline RawScan full_circle(const RayCaster& walls, const Pose2& map_from_laser, double sigma_m, Rng& rng,
                           int beams = 1440) {
  RawScan raw{.angle_min_rad = static_cast<float>(-kPi),
              .angle_increment_rad = static_cast<float>(2.0 * kPi / beams),
              .range_min_m = 0.05F,
              .range_max_m = 30.0F};
  for (int i = 0; i < beams; ++i) {
    const double bearing = map_from_laser.theta_rad - kPi + 2.0 * kPi * i / beams;
    const auto hit = walls.cast(map_from_laser.translation(), {std::cos(bearing), std::sin(bearing)}, 30.0);
    raw.ranges_m.push_back(hit ? static_cast<float>(hit->range_m + rng.normal(sigma_m))
                               : std::numeric_limits<float>::infinity());
  }
  return raw;
}

}  // namespace beaconless::test
