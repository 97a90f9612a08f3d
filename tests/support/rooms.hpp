// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/ray_caster.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::test {

inline FloorPlan rectangle(double width_m, double height_m) {
  return {{{{0, 0}, {width_m, 0}, {width_m, height_m}, {0, height_m}, {0, 0}}}};
}

/// A room with a niche and a pillar: no symmetry.
inline FloorPlan niche_room() {
  return {{{{0, 0}, {6, 0}, {6, 2}, {7.5, 2}, {7.5, 3.2}, {6, 3.2}, {6, 5}, {0, 5}, {0, 0}},
           {{2.0, 3.4}, {2.5, 3.4}, {2.5, 3.9}, {2.0, 3.9}, {2.0, 3.4}}}};
}

inline FloorPlan l_room() { return {{{{0, 0}, {9, 0}, {9, 3.5}, {4, 3.5}, {4, 8}, {0, 8}, {0, 0}}}}; }

/// A hall with two rows of racks of different lengths, 1.1 m deep, and a post: aisles of 2.4 m.
inline FloorPlan rack_hall() {
  FloorPlan plan = rectangle(24, 14);
  const auto add = [&](double x, double y, double width, double depth) {
    plan.walls.push_back({{x, y}, {x + width, y}, {x + width, y + depth}, {x, y + depth}, {x, y}});
  };
  for (const double y : {2.4, 5.9, 9.4}) {
    add(2.5, y, 8.1, 1.1);
    add(13.0, y, 8.1 - 0.3 * y, 1.1);
  }
  add(22.0, 11.5, 0.3, 0.3);
  return plan;
}

/// A sweep of 1081 beams over 270 degrees from a pose, with Gaussian noise on the ranges.
inline RawScan sweep(const RayCaster& walls, const Pose2& map_from_laser, double sigma_m, Rng& rng,
                     Stamp stamp = {}) {
  RawScan raw{.stamp = stamp,
              .angle_min_rad = static_cast<float>(radians(-135.0)),
              .angle_increment_rad = static_cast<float>(radians(0.25)),
              .range_min_m = 0.1F,
              .range_max_m = 30.0F};
  for (int i = 0; i < 1081; ++i) {
    const double bearing = map_from_laser.theta_rad + static_cast<double>(raw.angle_min_rad) +
                           i * static_cast<double>(raw.angle_increment_rad);
    const auto hit = walls.cast(map_from_laser.translation(), {std::cos(bearing), std::sin(bearing)}, 30.0);
    raw.ranges_m.push_back(hit ? static_cast<float>(hit->range_m + rng.normal(sigma_m))
                               : std::numeric_limits<float>::infinity());
  }
  return raw;
}

inline std::vector<Eigen::Vector2d> points_of(const Scan& scan) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < scan.size(); ++i)
    if (scan.is_hit(i)) points.push_back(scan.point(i));
  return points;
}

}  // namespace beaconless::test
