// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/result.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/scan/raw_scan.hpp"

#include "bridges/ros1/messages.hpp"

namespace beaconless::ros1 {

/// How a laser sits on its robot, seen from above.
struct MountedLaser {
  Pose2 base_from_laser;
  bool is_upside_down = false;  ///< its beams turn the other way then
  double tilt_rad = 0.0;        ///< of its plane against the floor, 0 … pi/2
};

/// The laser of a transform base from laser. Errors: numbers that are not finite, a quaternion of length
/// zero, a plane that stands on its edge (over 30°).
Result<MountedLaser> mounted_laser(const Transform& base_from_laser);

/// A sweep as the laser would give it if it stood upright.
RawScan upright(const ScanMessage& scan, const MountedLaser& laser);

}  // namespace beaconless::ros1
