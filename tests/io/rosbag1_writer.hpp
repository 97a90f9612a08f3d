// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

// Plain C++17: the messages of ROS 1 are no C++20.
namespace beaconless {

struct BagScan {
  std::int64_t stamp_ns = 0;
  std::string frame_id;
  float angle_min_rad = 0.0F, angle_increment_rad = 0.0F, time_increment_s = 0.0F, scan_time_s = 0.0F;
  float range_min_m = 0.0F, range_max_m = 0.0F;
  std::vector<float> ranges_m, intensities;
};

struct BagPose {
  std::int64_t stamp_ns = 0;
  double x_m = 0.0, y_m = 0.0, theta_rad = 0.0;
};

enum class BagCompression { none, bz2, lz4 };

/// What a robot records, written by librosbag and the messages' own serializers.
struct BagContent {
  std::vector<BagScan> scans;       ///< /scan
  std::vector<BagScan> more_scans;  ///< /rear/scan
  std::vector<BagPose> odometry;    ///< /odom, with twist (1, 2, 3) m/s, m/s, rad/s
  std::vector<BagPose> transforms;  ///< /tf odom -> base_link, beside one base_link -> laser
  std::vector<BagPose> poses;       ///< /reference, PoseStamped
  std::vector<BagPose> fixes;       ///< /amcl_pose, PoseWithCovarianceStamped
  std::vector<BagPose> fixed;       ///< /tf_static base_link -> shell -> base_laser_link, half the way each
  bool is_fixed_latched = false;    ///< of a bag that was read
};

void write_bag(const std::string& path, const BagContent& content, BagCompression compression);

/// The first of every LaserScan's, Odometry's, PoseStamped's and TFMessage's transforms in a bag, by the
/// messages' own serializers; throws where one is not of that type.
BagContent read_bag(const std::string& path);

}  // namespace beaconless
