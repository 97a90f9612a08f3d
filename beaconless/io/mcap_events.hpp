// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"
#include "beaconless/io/mcap_writer.hpp"
#include "beaconless/pose_estimate.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io {

/// Writes events and estimates into an MCAP file as ROS 2 messages that viewers know, as they come.
///
/// Log times are the stamps, or that of the message before where stamps run backwards, so that readers keep
/// the order in which all was written. Ranges, stamps and bearings read back as the same bits; headings pass
/// through a quaternion. Differs: base_from_laser of a ReferencePose has no message and is left out.
class McapEventWriter {
 public:
  /// A path that cannot be written shows in `good()`.
  explicit McapEventWriter(const std::string& path, const McapLayout& layout = {})
      : file_(path, "ros2", layout) {}

  void write(const Scan& scan, std::string_view topic = "/scan");
  void write(const RawScan& scan, std::string_view topic = "/scan");  ///< sensor_msgs/msg/LaserScan

  /// nav_msgs/msg/Odometry where it tells a twist, else a transform odom -> base_link on /tf.
  void write(const Odometry& odometry);
  void write(const ReferencePose& reference);  ///< geometry_msgs/msg/PoseStamped

  /// The pose with its covariance on /beaconless/pose, the transform map -> base_link on /tf, and the rest on
  /// /diagnostics.
  void write(const PoseEstimate& estimate);

  /// A scan that was localized: all of the above, and where the laser sits on the robot on /tf_static.
  void write(const Scan& scan, const PoseEstimate& estimate, const Pose2& base_from_laser);

  bool good() const { return file_.good(); }
  Result<Done> finish() { return file_.finish(); }

 private:
  void put(std::string_view topic, std::string_view type, Stamp stamp, std::string_view body);

  McapWriter file_;
  std::map<std::pair<std::string, std::string>, std::uint16_t> channels_;  ///< by topic and type
  std::set<std::string> mounted_;  ///< frames that /tf_static has told
  std::uint64_t last_log_ns_ = 0;
};

}  // namespace beaconless::io
