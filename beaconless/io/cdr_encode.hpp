// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "beaconless/event.hpp"
#include "beaconless/pose_estimate.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io {

/// Bodies of ROS 2 messages, CDR with its header, as they lie in MCAP and db3 files and on the wire.
///
/// Poses lie in the plane. A stamp outside what ROS can say (1901 to 2038) becomes the nearest that it can.
std::string encode_laser_scan(const RawScan& scan);  ///< sensor_msgs/msg/LaserScan

/// nav_msgs/msg/Odometry; its covariances are 0: not told.
std::string encode_odometry(const Odometry& odometry, std::string_view frame, std::string_view child_frame);

std::string encode_pose_stamped(Stamp stamp, std::string_view frame, const Pose2& pose);

/// geometry_msgs/msg/PoseWithCovarianceStamped; x, y and yaw of the 6×6 covariance are set.
std::string encode_pose_with_covariance_stamped(const PoseEstimate& estimate, std::string_view frame);

/// tf2_msgs/msg/TFMessage with one transform.
std::string encode_transform(Stamp stamp, std::string_view frame, std::string_view child_frame,
                             const Pose2& frame_from_child);

/// diagnostic_msgs/msg/DiagnosticArray with one DiagnosticStatus named `name`: OK, WARN (degraded,
/// relocalizing) or ERROR, the reason as its message, and status, reason, quality, protection levels and
/// jumped as values.
std::string encode_diagnostics(const PoseEstimate& estimate, std::string_view name);

}  // namespace beaconless::io
