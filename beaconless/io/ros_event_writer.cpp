// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/ros_event_writer.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "beaconless/io/cdr_encode.hpp"
#include "beaconless/io/raw_from.hpp"
#include "beaconless/io/ros1_encode.hpp"

namespace beaconless::io {
namespace {

constexpr std::string_view kMap = "map";
constexpr std::string_view kOdom = "odom";
constexpr std::string_view kBase = "base_link";
constexpr std::string_view kLaser = "laser";
constexpr std::string_view kTransforms = "tf2_msgs/TFMessage";
constexpr std::string_view kFixed = "/tf_static";

/// The topic that a source names; nothing of a keyword of a log.
std::string topic_of(const std::string& source) {
  return source.starts_with('/') ? source.substr(0, source.find(' ')) : "";
}

/// "/reference/truepos" of a keyword TRUEPOS.
std::string reference_topic_of(const std::string& keyword) {
  std::string topic = "/reference";
  if (!keyword.empty()) topic += '/';
  for (const char c : keyword) {
    const auto byte = static_cast<unsigned char>(c);
    topic += std::isalnum(byte) != 0 ? static_cast<char>(std::tolower(byte)) : '_';
  }
  return topic;
}

/// Where a transform of dead reckoning goes.
struct Transform {
  std::string topic = "/tf";
  std::string parent{kOdom};
  std::string child{kBase};
};

/// What a source "/tf odom->base_link" says.
Transform transform_of(const std::string& source) {
  const std::size_t space = source.find(' ');
  const std::size_t arrow = source.find("->");
  if (space == std::string::npos || arrow == std::string::npos || arrow < space) return {};
  const std::string topic = topic_of(source);
  return {topic.empty() ? "/tf" : topic, source.substr(space + 1, arrow - space - 1),
          source.substr(arrow + 2)};
}

/// "sensor_msgs/msg/LaserScan" of "sensor_msgs/LaserScan".
std::string ros2_type(std::string_view type) {
  std::string name(type);
  return name.insert(name.find('/') + 1, "msg/");
}

}  // namespace

void RosEventWriter::place_laser(const Pose2& base_from_laser, std::string_view base_frame) {
  if (!mount_) mount_.emplace();
  mount_->base_from_laser = base_from_laser;
  mount_->base_frame = base_frame.empty() ? kBase : base_frame;
}

void RosEventWriter::put(std::string_view topic, std::string_view type, Stamp stamp, std::string_view body) {
  last_recorded_ns_ = std::max(last_recorded_ns_, stamp.ns);
  const std::string name = encoding_ == RosEncoding::cdr ? ros2_type(type) : std::string(type);
  sink_.write({topic, name, last_recorded_ns_, std::max<std::int64_t>(stamp.ns, 0), topic == kFixed, body});
}

std::string RosEventWriter::transform(Stamp stamp, std::string_view parent, std::string_view child,
                                      const Pose2& pose) const {
  return encoding_ == RosEncoding::cdr ? encode_transform(stamp, parent, child, pose)
                                       : ros1::encode_transform(stamp, parent, child, pose);
}

void RosEventWriter::put_scan(RawScan scan, std::string_view topic) {
  if (mount_) {
    if (scan.frame_id.empty() || scan.frame_id == mount_->base_frame) scan.frame_id = kLaser;
    if (placed_.insert(scan.frame_id).second)
      put(kFixed, kTransforms, scan.stamp,
          transform(scan.stamp, mount_->base_frame, scan.frame_id, mount_->base_from_laser));
  }
  put(topic, "sensor_msgs/LaserScan", scan.stamp,
      encoding_ == RosEncoding::cdr ? encode_laser_scan(scan) : ros1::encode_laser_scan(scan));
}

void RosEventWriter::write(const RawScan& scan, std::string_view topic) { put_scan(scan, topic); }

void RosEventWriter::write(const Scan& scan, std::string_view topic) { put_scan(raw_from(scan), topic); }

void RosEventWriter::write(const Odometry& odometry) {
  if (odometry.twist_per_s) {
    const std::string topic = topic_of(odometry.source);
    return put(topic.empty() ? "/odom" : topic, "nav_msgs/Odometry", odometry.stamp,
               encoding_ == RosEncoding::cdr ? encode_odometry(odometry, kOdom, kBase)
                                             : ros1::encode_odometry(odometry, kOdom, kBase));
  }
  const Transform to = transform_of(odometry.source);
  put(to.topic, kTransforms, odometry.stamp,
      transform(odometry.stamp, to.parent, to.child, odometry.odom_from_base));
}

void RosEventWriter::write(const ReferencePose& reference) {
  if (reference.base_from_laser && !mount_) place_laser(*reference.base_from_laser);
  const std::string topic = topic_of(reference.source);
  const Pose2& pose = reference.map_from_base;
  put(topic.empty() ? reference_topic_of(reference.source) : topic, "geometry_msgs/PoseStamped",
      reference.stamp,
      encoding_ == RosEncoding::cdr ? encode_pose_stamped(reference.stamp, kMap, pose)
                                    : ros1::encode_pose_stamped(reference.stamp, kMap, pose));
}

}  // namespace beaconless::io
