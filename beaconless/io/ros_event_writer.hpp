// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "beaconless/event.hpp"
#include "beaconless/io/ros_message_sink.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io {

/// How messages are serialized: as ROS 2 does (CDR), or as ROS 1.
enum class RosEncoding { cdr, ros1 };

/// Turns events into the ROS messages that ros_events.hpp turns into events again.
///
/// Recording times are the stamps, or that of the message before where stamps run backwards, so that readers
/// keep the order in which all was written. Ranges, stamps and bearings read back as the same bits; headings
/// pass through a quaternion.
class RosEventWriter {
 public:
  /// `sink` must live as long.
  RosEventWriter(RosMessageSink& sink, RosEncoding encoding) : sink_(sink), encoding_(encoding) {}

  /// Where the laser of the scans to come sits; goes to /tf_static before the first of them in each frame. A
  /// scan whose frame has no name, or that of the base, is then told to be in the frame "laser", or nobody
  /// could place it. A frame's first place stays. An empty `base_frame` is "base_link".
  void place_laser(const Pose2& base_from_laser, std::string_view base_frame = {});

  /// Nobody knows where the laser of the scans to come sits.
  void unplace_laser() { mount_.reset(); }

  void write(const RawScan& scan, std::string_view topic);  ///< sensor_msgs/LaserScan
  void write(const Scan& scan, std::string_view topic);

  /// nav_msgs/Odometry where it tells a twist, else a transform odom -> base_link on /tf.
  void write(const Odometry& odometry);
  /// geometry_msgs/PoseStamped; its base_from_laser, if it has one, places a laser that was not placed.
  void write(const ReferencePose& reference);

  /// A message by its own body; `type` is written without "msg/".
  void put(std::string_view topic, std::string_view type, Stamp stamp, std::string_view body);

 private:
  struct Mount {
    Pose2 base_from_laser;
    std::string base_frame;
  };

  void put_scan(RawScan scan, std::string_view topic);
  std::string transform(Stamp stamp, std::string_view parent, std::string_view child,
                        const Pose2& pose) const;

  RosMessageSink& sink_;
  RosEncoding encoding_;
  std::optional<Mount> mount_;
  std::set<std::string> placed_;  ///< frames of lasers that /tf_static has
  std::int64_t last_recorded_ns_ = 0;
};

}  // namespace beaconless::io
