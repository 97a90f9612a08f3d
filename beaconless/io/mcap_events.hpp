// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"
#include "beaconless/io/mcap_sink.hpp"
#include "beaconless/io/ros_event_writer.hpp"
#include "beaconless/pose_estimate.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io {

/// Writes events and estimates into an MCAP file as ROS 2 messages that viewers know, as they come.
///
/// See RosEventWriter for what becomes of them.
class McapEventWriter {
 public:
  /// A path that cannot be written shows in `good()`.
  explicit McapEventWriter(const std::string& path, const McapLayout& layout = {})
      : path_(path), file_(path, layout), events_(file_, RosEncoding::cdr) {}
  McapEventWriter(const McapEventWriter&) = delete;
  McapEventWriter& operator=(const McapEventWriter&) = delete;
  ~McapEventWriter() = default;

  /// Where the laser of the scans to come sits: /tf_static.
  void place_laser(const Pose2& base_from_laser, std::string_view base_frame = {}) {
    events_.place_laser(base_from_laser, base_frame);
  }

  void write(const Scan& scan, std::string_view topic = "/scan") { events_.write(scan, topic); }
  void write(const RawScan& scan, std::string_view topic = "/scan") { events_.write(scan, topic); }
  void write(const Odometry& odometry) { events_.write(odometry); }
  void write(const ReferencePose& reference) { events_.write(reference); }

  /// The pose with its covariance on /beaconless/pose, the transform map -> base_link on /tf, and the rest on
  /// /diagnostics.
  void write(const PoseEstimate& estimate);

  /// A scan that was localized: all of the above, and where the laser sits on the robot on /tf_static.
  void write(const Scan& scan, const PoseEstimate& estimate, const Pose2& base_from_laser,
             std::string_view topic = "/scan");

  bool good() const { return file_.good(); }

  /// Writes what is left and the summary, and says whether all of it has reached the file.
  Result<Done> finish();

 private:
  std::string path_;
  McapSink file_;
  RosEventWriter events_;
};

}  // namespace beaconless::io
