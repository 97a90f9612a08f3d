// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "beaconless/event.hpp"
#include "beaconless/geometry/pose_fusion.hpp"
#include "beaconless/pose_estimate.hpp"
#include "beaconless/track/motion_filter.hpp"
#include "beaconless/track/odometry_track.hpp"

namespace beaconless {

/// Where one of several lasers last told the robot to be, carried to the moments of the others' scans.
///
/// By the wheels where they agree with it, else by the motion of its last poses, forwards and back.
class LaserFix {
 public:
  LaserFix(const MotionConfig& config, const OdometryConfig& odometry)
      : motion_(config), odometry_(odometry) {}

  void start_at(const Pose2& map_from_base);
  void hear(const Odometry& odometry) { odometry_.add(odometry.stamp, odometry.odom_from_base); }

  /// Takes in a pose that is ok or degraded.
  void take(const PoseEstimate& estimate);

  /// In: a stamp within a second or so of the last pose, of which there is one.
  PoseOpinion at(Stamp stamp) const;

 private:
  MotionFilter motion_;
  OdometryTrack odometry_;
  PoseOpinion last_;
  std::optional<Stamp> stamp_;
};

}  // namespace beaconless
