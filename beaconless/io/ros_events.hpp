// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/io/frame_transform.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/ros_message.hpp"

namespace beaconless::io {

/// "sensor_msgs/LaserScan" of "sensor_msgs/msg/LaserScan".
std::string short_type(std::string_view type);

/// Whether messages of a type are laser scans; both ways to write a type are known, here as below.
bool is_laser_scan_type(std::string_view type);

/// Whether messages of a type give events besides the scans: odometry, poses, tf.
bool is_pose_type(std::string_view type);

/// Whether messages of a type are transforms of tf.
bool is_transforms_type(std::string_view type);

/// The transforms in a message of such a type.
Result<std::vector<FrameTransform>> transforms_of(const RosMessage& message);

/// The events in the messages of a source, in their order. What cannot be decoded is reported, with `path`
/// and the moment of its recording, and passed over.
std::unique_ptr<EventStream> ros_events(std::string path, std::unique_ptr<RosMessageSource> source,
                                        RecordingOptions options);

}  // namespace beaconless::io
