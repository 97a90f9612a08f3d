// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "beaconless/core/stamp.hpp"
#include "beaconless/event.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless::io {

/// One transform of tf as it was sent: unchecked, the quaternion of any length.
struct FrameTransform {
  Stamp stamp;
  std::string parent;
  std::string child;
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();

  /// The plane's part of it; NaN heading where the quaternion says nothing.
  Pose2 planar() const;
};

/// Whether a transform is dead reckoning: its parent is an odom frame ("odom", "robot1/odom",
/// "odom_combined"), its child is no map, and it is finite.
bool is_odom_transform(const FrameTransform& transform);

/// Those of the transforms that are dead reckoning; `source` of each is "parent->child".
std::vector<Odometry> odometry_of(const std::vector<FrameTransform>& transforms);

}  // namespace beaconless::io
