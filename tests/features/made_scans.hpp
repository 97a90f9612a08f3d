// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/ray_caster.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::test {

/// The bearings of a scanner; the defaults are 1081 beams over 270 degrees.
struct Fan {
  int beams = 1081;
  double first_deg = -135.0;
  double step_deg = 0.25;
};

inline constexpr Fan kFullCircle{.beams = 1440, .first_deg = -180.0, .step_deg = 0.25};

/// A scan whose range at each beam is `range_m(beam, bearing in rad)`; 0 is no information.
inline Scan scan_of(const Fan& fan, const std::function<double(int, double)>& range_m) {
  RawScan raw{.angle_min_rad = static_cast<float>(radians(fan.first_deg)),
              .angle_increment_rad = static_cast<float>(radians(fan.step_deg)),
              .range_min_m = 0.01F,
              .range_max_m = 100.0F};
  for (int i = 0; i < fan.beams; ++i) {
    const double bearing =
        static_cast<double>(raw.angle_min_rad) + i * static_cast<double>(raw.angle_increment_rad);
    raw.ranges_m.push_back(static_cast<float>(range_m(i, bearing)));
  }
  return Scan::make(raw).value();
}

/// What a scanner sees of walls from a pose, with Gaussian noise on the ranges.
inline Scan seen(const RayCaster& walls, const Pose2& map_from_laser, double sigma_m, Rng& rng,
                 const Fan& fan = {}) {
  return scan_of(fan, [&](int, double bearing) {
    const double angle = map_from_laser.theta_rad + bearing;
    const auto hit = walls.cast(map_from_laser.translation(), {std::cos(angle), std::sin(angle)}, 99.0);
    return hit ? hit->range_m + (sigma_m > 0.0 ? rng.normal(sigma_m) : 0.0)
               : std::numeric_limits<double>::infinity();
  });
}

/// The same scan with a share of its beams without information.
inline Scan with_holes(const Scan& scan, double share, Rng& rng) {
  return scan_of(
      {static_cast<int>(scan.size()), degrees(scan.angle_min_rad()), degrees(scan.angle_increment_rad())},
      [&](int i, double) {
        const double range = scan.ranges_m()[static_cast<std::size_t>(i)];
        return rng.uniform() < share ? 0.0 : range;
      });
}

/// A full circle that begins `beams` later: beam b becomes beam b - beams.
inline Scan turned(const Scan& scan, std::size_t beams) {
  return scan_of(
      {static_cast<int>(scan.size()), degrees(scan.angle_min_rad()), degrees(scan.angle_increment_rad())},
      [&](int i, double) -> double {
        return scan.ranges_m()[(static_cast<std::size_t>(i) + beams) % scan.size()];
      });
}

}  // namespace beaconless::test
