// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io {

/// Opens text that `rostopic echo TOPIC` (ROS 1) or `ros2 topic echo --full-length TOPIC` printed, plain or
/// gzip.
///
/// Messages: LaserScan, Odometry, PoseStamped, PoseWithCovarianceStamped; others are passed over. The text
/// does not name its topics, so they are called "scan", "odometry" and "pose" here. A last message
/// without its `---` is read only if it is a scan with its intensities. Errors: the arrays of the first scan
/// were left out or cut short when it was echoed. Source: dissertation, Appendix A.2. Cost: one pass over the
/// file here, to count the messages.
Result<Recording> open_rostopic_echo(const std::string& path, const RecordingOptions& options = {});

/// The text that `rostopic echo` prints for a scan, the closing `---` included. Reads back as the very same
/// floats.
std::string to_rostopic_echo(const RawScan& scan);

/// Writes scans as `rostopic echo` would.
Result<Done> write_rostopic_echo(const std::string& path, std::span<const RawScan> scans);

}  // namespace beaconless::io
