// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// Opens a ROS 2 bag of SQLite files: one `.db3`, one `.db3.zstd`, or a folder of them, with or without its
/// metadata.yaml; `topic` chooses among its LaserScan topics.
///
/// Besides the scans it gives Odometry and ReferencePose as open_rosbag1 does, in the order in which they
/// were recorded; stamps are those of the messages' headers. tf_static tells the laser's place. Messages that
/// are not CDR are not read. Errors: damaged, cut, being written to, not closed by its recorder, no bag; a
/// folder without any file or with a file missing. Cost: opening looks at each row once, and unpacks what is
/// compressed as a whole into the temporary folder.
Result<Recording> open_rosbag2(const std::string& path, const RecordingOptions& options = {});

/// Whether a folder looks like a ROS 2 bag.
bool is_rosbag2_folder(const std::string& path);

/// Whether a file that begins like this is one of a ROS 2 bag, or another SQLite database.
bool is_rosbag2_file(std::string_view head);

}  // namespace beaconless::io
