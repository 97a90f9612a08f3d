// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/node_config.hpp"

#include "beaconless/core/parse.hpp"

namespace beaconless::ros1 {
namespace {

constexpr Range kPlace{-1e6, 1e6};
constexpr Range kSeconds{0.0, 60.0};
constexpr Range kVariance{0.0, 1e4};
constexpr Range kLimit{-1.0, 1e5};

}  // namespace

void describe(Fields& fields, NodeConfig& config) {
  fields("global_frame_id", config.global_frame_id, Words{}, "the frame of the map, and of poses");
  fields("odom_frame_id", config.odom_frame_id, Words{},
         "the frame of the wheels' poses; empty: there are none");
  fields("base_frame_id", config.base_frame_id, Words{}, "the frame of the robot, which is localized");
  fields("tf_broadcast", config.tf_broadcast, "send map to odom, or map to base without wheels, to tf");
  fields("transform_tolerance", config.transform_tolerance, kSeconds,
         "how far ahead the transform is dated (s)");
  fields("initial_pose_x", config.initial_pose_x, kPlace, "where the robot starts, if it is told (m)");
  fields("initial_pose_y", config.initial_pose_y, kPlace, "where the robot starts, if it is told (m)");
  fields("initial_pose_a", config.initial_pose_a, {-7.0, 7.0}, "its heading there (rad)");
  fields("initial_cov_xx", config.initial_cov_xx, kVariance, "how well that is known (m²)");
  fields("initial_cov_yy", config.initial_cov_yy, kVariance, "how well that is known (m²)");
  fields("initial_cov_aa", config.initial_cov_aa, kVariance, "how well the heading is known (rad²)");
  fields("laser_min_range", config.laser_min_range, kLimit,
         "nearer beams are no hits (m); -1: the scan's own");
  fields("laser_max_range", config.laser_max_range, kLimit,
         "beams this far or further are no returns (m); -1: the scan's own");
  fields("first_map_only", config.first_map_only, "later maps of the topic are passed over");
  fields("start", config.start, Words{"auto", "wait"},
         "without an initial pose: look on the whole map, or wait for /initialpose");
  fields("scan_topics", config.scan_topics, Words{},
         "the topics of several lasers, with blanks between; empty: the topic scan");
  fields("map_file", config.map_file, Words{}, "YAML of map_server, or a floor plan; empty: the topic map");
  fields("pose_file", config.pose_file, Words{}, "keeps the last good pose, and is started from");
  fields("transform_wait", config.transform_wait, kSeconds, "how long a scan waits for its transform (s)");
  fields("late_after", config.late_after, kSeconds, "an older scan is complained of (s)");
  fields("stamp_is", config.stamp_is, {"first", "middle", "last"}, "the beam that the scans' stamps mean");
  fields("sweep_time", config.sweep_time, {0.0, 59.0},
         "from a sweep's first beam to its last (s), where the driver does not tell; 0: believe it");
}

std::vector<std::string> scan_topics_of(const NodeConfig& config) {
  std::vector<std::string> topics;
  for (const std::string_view topic : split_words(config.scan_topics, ", ")) topics.emplace_back(topic);
  return topics.empty() ? std::vector<std::string>{"scan"} : topics;
}

ScanGate gate_of(const NodeConfig& config) {
  ScanGate gate;
  gate.stamp_is = config.stamp_is;
  gate.sweep_time_s = config.sweep_time;
  if (config.laser_min_range > 0.0) gate.range_min_m = static_cast<float>(config.laser_min_range);
  if (config.laser_max_range > 0.0) gate.range_max_m = static_cast<float>(config.laser_max_range);
  return gate;
}

}  // namespace beaconless::ros1
