// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "beaconless/event.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io::ros1 {

/// Bodies of ROS 1 messages as they lie in bags and on the wire; what ros1_message.hpp decodes.
///
/// Poses lie in the plane; `seq` of every Header is 0. A stamp outside what ROS 1 can say (1970 to 2106)
/// becomes the nearest that it can.
std::string encode_laser_scan(const RawScan& scan);  ///< sensor_msgs/LaserScan

/// nav_msgs/Odometry; its covariances are 0: not told.
std::string encode_odometry(const Odometry& odometry, std::string_view frame, std::string_view child_frame);

std::string encode_pose_stamped(Stamp stamp, std::string_view frame, const Pose2& pose);

/// tf2_msgs/TFMessage with one transform.
std::string encode_transform(Stamp stamp, std::string_view frame, std::string_view child_frame,
                             const Pose2& frame_from_child);

}  // namespace beaconless::io::ros1
