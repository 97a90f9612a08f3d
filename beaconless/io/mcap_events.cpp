// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_events.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "beaconless/io/cdr_encode.hpp"
#include "beaconless/io/raw_from.hpp"
#include "beaconless/io/ros2_schemas.hpp"

namespace beaconless::io {
namespace {

constexpr std::string_view kMap = "map";
constexpr std::string_view kOdom = "odom";
constexpr std::string_view kBase = "base_link";
constexpr std::string_view kLaser = "laser";
constexpr std::string_view kTransforms = "tf2_msgs/msg/TFMessage";

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

/// "odom" and "base_link" of a source "/tf odom->base_link"; those when it tells none.
std::pair<std::string, std::string> frames_of(const std::string& source) {
  const std::size_t space = source.find(' ');
  const std::size_t arrow = source.find("->");
  if (space == std::string::npos || arrow == std::string::npos || arrow < space)
    return {std::string(kOdom), std::string(kBase)};
  return {source.substr(space + 1, arrow - space - 1), source.substr(arrow + 2)};
}

}  // namespace

void McapEventWriter::put(std::string_view topic, std::string_view type, Stamp stamp, std::string_view body) {
  const auto key = std::pair{std::string(topic), std::string(type)};
  auto channel = channels_.find(key);
  if (channel == channels_.end()) {
    McapSchema schema{.name = key.second, .encoding = "ros2msg", .text = ros2_schema(type)};
    channel = channels_.emplace(key, file_.add_channel(topic, "cdr", std::move(schema))).first;
  }
  const auto stamp_ns = static_cast<std::uint64_t>(std::max<std::int64_t>(stamp.ns, 0));
  last_log_ns_ = std::max(last_log_ns_, stamp_ns);
  file_.write(channel->second, last_log_ns_, stamp_ns, body);
}

void McapEventWriter::write(const RawScan& scan, std::string_view topic) {
  put(topic, "sensor_msgs/msg/LaserScan", scan.stamp, encode_laser_scan(scan));
}

void McapEventWriter::write(const Scan& scan, std::string_view topic) { write(raw_from(scan), topic); }

void McapEventWriter::write(const Odometry& odometry) {
  if (odometry.twist_per_s) {
    const std::string topic = topic_of(odometry.source);
    return put(topic.empty() ? "/odom" : topic, "nav_msgs/msg/Odometry", odometry.stamp,
               encode_odometry(odometry, kOdom, kBase));
  }
  const auto [parent, child] = frames_of(odometry.source);
  put("/tf", kTransforms, odometry.stamp,
      encode_transform(odometry.stamp, parent, child, odometry.odom_from_base));
}

void McapEventWriter::write(const ReferencePose& reference) {
  const std::string topic = topic_of(reference.source);
  put(topic.empty() ? reference_topic_of(reference.source) : topic, "geometry_msgs/msg/PoseStamped",
      reference.stamp, encode_pose_stamped(reference.stamp, kMap, reference.map_from_base));
}

void McapEventWriter::write(const PoseEstimate& estimate) {
  put("/beaconless/pose", "geometry_msgs/msg/PoseWithCovarianceStamped", estimate.stamp,
      encode_pose_with_covariance_stamped(estimate, kMap));
  put("/tf", kTransforms, estimate.stamp,
      encode_transform(estimate.stamp, kMap, kBase, estimate.map_from_base));
  put("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", estimate.stamp,
      encode_diagnostics(estimate, "beaconless"));
}

void McapEventWriter::write(const Scan& scan, const PoseEstimate& estimate, const Pose2& base_from_laser) {
  RawScan raw = raw_from(scan);
  if (raw.frame_id.empty() || raw.frame_id == kBase) raw.frame_id = kLaser;  // or nobody could place it
  if (mounted_.insert(raw.frame_id).second)
    put("/tf_static", kTransforms, scan.stamp(),
        encode_transform(scan.stamp(), kBase, raw.frame_id, base_from_laser));
  write(estimate);
  write(raw);
}

}  // namespace beaconless::io
