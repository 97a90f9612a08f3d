// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "beaconless/features/keypoint.hpp"
#include "beaconless/geometry/pose2.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless::test {

/// The same sweep with the sensor turned clockwise by whole beams, so that the world turns counter-clockwise
/// in its frame by as many; full circles only.
inline RawScan turned_by_beams(const RawScan& raw, std::size_t beams) {
  RawScan turned = raw;
  const std::size_t size = raw.ranges_m.size();
  for (std::size_t i = 0; i < size; ++i) turned.ranges_m[(i + beams) % size] = raw.ranges_m[i];
  return turned;
}

/// A full circle of `size` beams without noise, the first one straight back.
inline RawScan circle_sweep(const RayCaster& walls, const Pose2& map_from_laser, std::size_t size) {
  RawScan raw{.angle_min_rad = static_cast<float>(-kPi),
              .angle_increment_rad = static_cast<float>(2.0 * kPi / static_cast<double>(size)),
              .range_min_m = 0.1F,
              .range_max_m = 30.0F};
  raw.ranges_m.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double bearing =
        map_from_laser.theta_rad - kPi + 2.0 * kPi * static_cast<double>(i) / static_cast<double>(size);
    const auto hit = walls.cast(map_from_laser.translation(), {std::cos(bearing), std::sin(bearing)}, 30.0);
    raw.ranges_m[i] = hit ? static_cast<float>(hit->range_m) : std::numeric_limits<float>::infinity();
  }
  return raw;
}

/// The corners of niche_room() with the bisector into the free space of the room, map frame.
inline std::vector<Keypoint> niche_room_corners() {
  const auto corner = [](double x, double y, double deg) {
    return Keypoint{.point = {x, y}, .orientation_rad = radians(deg)};
  };
  return {corner(0, 0, 45),       corner(6, 0, 135),     corner(6, 2, 135),    corner(7.5, 2, 135),
          corner(7.5, 3.2, -135), corner(6, 3.2, -135),  corner(6, 5, -135),   corner(0, 5, -45),
          corner(2, 3.4, -135),   corner(2.5, 3.4, -45), corner(2.5, 3.9, 45), corner(2, 3.9, 135)};
}

/// Keypoints of the map frame as the sensor has them.
inline std::vector<Keypoint> seen_from(const std::vector<Keypoint>& keypoints, const Pose2& map_from_laser) {
  std::vector<Keypoint> seen;
  seen.reserve(keypoints.size());
  for (Keypoint keypoint : keypoints) {
    keypoint.point = map_from_laser.inverse() * keypoint.point;
    keypoint.orientation_rad = wrap_angle(keypoint.orientation_rad - map_from_laser.theta_rad);
    seen.push_back(keypoint);
  }
  return seen;
}

}  // namespace beaconless::test
