// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::ros1 {

/// What the node itself is told, under the names and defaults that these have in ROS's amcl where it has
/// them.
struct NodeConfig {
  std::string global_frame_id = "map";
  std::string odom_frame_id = "odom";  ///< "": there is no odometry
  std::string base_frame_id = "base_link";
  bool tf_broadcast = true;
  double transform_tolerance = 0.1;
  double initial_pose_x = 0.0;
  double initial_pose_y = 0.0;
  double initial_pose_a = 0.0;
  double initial_cov_xx = 0.25;
  double initial_cov_yy = 0.25;
  double initial_cov_aa = 0.06853891909122467;  // (15°)²
  double laser_min_range = -1.0;
  double laser_max_range = -1.0;
  bool first_map_only = false;

  // Not in ROS's amcl.
  std::string start = "auto";
  std::string scan_topics;  ///< "": the topic scan; else several, with blanks or commas between
  std::string map_file;
  std::string pose_file;
  double transform_wait = 0.2;
  double late_after = 0.5;
  StampIs stamp_is = StampIs::first_beam;
  double sweep_time = 0.0;
};

void describe(Fields& fields, NodeConfig& config);

/// The topics of the scans, one a laser.
std::vector<std::string> scan_topics_of(const NodeConfig& config);

/// What Scan::make may assume.
ScanGate gate_of(const NodeConfig& config);

}  // namespace beaconless::ros1
