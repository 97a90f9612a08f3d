// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/mounted_laser.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "beaconless/io/quaternion_yaw.hpp"

namespace beaconless::ros1 {
namespace {

constexpr double kSteepest_rad = radians(30.0);

}  // namespace

Result<MountedLaser> mounted_laser(const Transform& base_from_laser) {
  const Transform& t = base_from_laser;
  // The x axis of the laser in the base frame tells its heading, upside down or not.
  const auto heading_rad = io::yaw_rad_of_quaternion(t.qx, t.qy, t.qz, t.qw);
  if (!heading_rad || !std::isfinite(t.x_m) || !std::isfinite(t.y_m))
    return Error{"tf", "the transform from base to laser is not finite, or its quaternion is of length zero",
                 "look at who publishes it: rosrun tf tf_echo BASE LASER"};
  const double squared_length = t.qx * t.qx + t.qy * t.qy + t.qz * t.qz + t.qw * t.qw;
  const double up = 1.0 - 2.0 * (t.qx * t.qx + t.qy * t.qy) / squared_length;
  MountedLaser laser{{t.x_m, t.y_m, *heading_rad}, up < 0.0, std::acos(std::min(std::abs(up), 1.0))};
  if (laser.tilt_rad > kSteepest_rad)
    return Error{"tf", fmt::format("the laser's plane is tilted by {:.0f} degrees", degrees(laser.tilt_rad)),
                 "only a laser that scans along the floor can be used"};
  return laser;
}

RawScan upright(const ScanMessage& scan, const MountedLaser& laser) {
  const float sign = laser.is_upside_down ? -1.0F : 1.0F;
  return {.stamp = Stamp{scan.stamp_ns},
          .frame_id = scan.frame_id,
          .angle_min_rad = sign * scan.angle_min_rad,
          .angle_increment_rad = sign * scan.angle_increment_rad,
          .time_increment_s = scan.time_increment_s,
          .scan_time_s = scan.scan_time_s,
          .range_min_m = scan.range_min_m,
          .range_max_m = scan.range_max_m,
          .ranges_m = scan.ranges_m,
          .intensities = scan.intensities};
}

}  // namespace beaconless::ros1
