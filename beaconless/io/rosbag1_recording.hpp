// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// Opens a ROS 1 bag, format 2.0, with chunks plain, bz2 or lz4; `topic` chooses among its LaserScan topics.
///
/// Besides the scans it gives Odometry (nav_msgs/Odometry, and every transform of tf whose parent frame is an
/// odom frame) and ReferencePose (PoseStamped, PoseWithCovarianceStamped), in the order in which they were
/// recorded. Stamps are those of the messages' headers. tf_static tells the laser's place. Errors: another
/// bag format, no or a broken index, a damaged chunk, an encrypted bag; a build without ROS 1 bags. Cost:
/// opening walks through the bag once, unpacking it, because librosbag trusts every length it reads; and with
/// tf_static once more the chunks that hold it, see told_laser.
Result<Recording> open_rosbag1(const std::string& path, const RecordingOptions& options = {});

}  // namespace beaconless::io
