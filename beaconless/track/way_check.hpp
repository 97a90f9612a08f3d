// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/stamp.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/track/odometry_track.hpp"

namespace beaconless {

/// Whether the wheels and the poses tell the same way.
///
/// Along a corridor a pose can slide, or stand while the robot drives, and every scan fits. Wheels that have
/// told the same way as the poses for some metres and then part from them by far more than wheels do are not
/// to be passed over: either they slip, or the poses are wrong. Allocates nothing.
class WayCheck {
 public:
  /// Forgets the way so far; wheels must agree anew before they are heard.
  void begin();

  /// Takes in where the base was at a scan. True when the two have parted, once.
  bool part(Stamp stamp, const Pose2& map_from_base, const OdometryTrack& odometry);

 private:
  void begin_stretch(Stamp stamp, const Pose2& map_from_base);

  bool begun_ = false;
  Stamp last_;
  Pose2 from_;       // the pose at the beginning of this stretch
  Pose2 by_wheels_;  // the way since, as the wheels tell it
  double driven_m_ = 0.0;
  int agreed_ = 0;  // stretches in a row
};

}  // namespace beaconless
