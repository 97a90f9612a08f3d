// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// Opens an MCAP file with messages of ROS 1 or ROS 2; `topic` chooses among its LaserScan topics.
///
/// The events are those of open_rosbag1, in the order of their log times where the file has chunks (see
/// McapMessages); stamps are those of the messages' headers. A file that was cut, or has no summary, is read
/// as far as it goes and told as a Problem, as is one whose data do not match their checksum. tf_static tells
/// the laser's place. Errors: not an MCAP file; scans in an encoding that is not read (json, protobuf). Cost:
/// see survey_mcap; and with tf_static once more the chunks that hold it, and the first with a scan and with
/// a transform of odometry: message indexes tell which these are, or what survey_mcap saw when it had to
/// unpack all. Without chunks: a walk to the last tf_static.
Result<Recording> open_mcap(const std::string& path, const RecordingOptions& options = {});

}  // namespace beaconless::io
