// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/io/map_identity.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless::io {

/// Where a robot was before it was switched off: what it knows when it is switched on again.
struct LastPose {
  Stamp stamp;
  Pose2 map_from_base;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< see PoseEstimate
  Status status = Status::ok;
  double quality = 0.0;
  MapIdentity map;

  friend bool operator==(const LastPose&, const LastPose&) = default;
};

LastPose last_pose_of(const PoseEstimate& estimate, const MapIdentity& map);

/// Writes it as a small YAML file, see write_file_atomically. Every number reads back as the same bits.
Result<Done> write_last_pose(const std::string& path, const LastPose& pose);

/// Reads what write_last_pose wrote.
///
/// Errors (with path:line where there is one): missing, not YAML, cut short or edited (its last line is the
/// hash of those before), a value that is missing, not finite, or no status.
Result<LastPose> read_last_pose(const std::string& path);

/// Whether the pose of the file `path` is one on this map. Errors: it is of another, or the map has changed.
Result<Done> check_map(const LastPose& pose, const std::string& path, const MapIdentity& map);

}  // namespace beaconless::io
