// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// Plain C++17, without a type of ROS: what stands on both sides of the link.
namespace beaconless::ros1 {

/// A place and a turn in space: metres, and a quaternion that need not be one of length 1 yet.
struct Transform {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double qx = 0.0, qy = 0.0, qz = 0.0, qw = 1.0;
};

/// sensor_msgs/LaserScan, field by field.
struct ScanMessage {
  std::int64_t stamp_ns = 0;
  std::string frame_id;
  float angle_min_rad = 0.0F;
  float angle_increment_rad = 0.0F;
  float time_increment_s = 0.0F;
  float scan_time_s = 0.0F;
  float range_min_m = 0.0F;
  float range_max_m = 0.0F;
  std::vector<float> ranges_m;
  std::vector<float> intensities;
};

/// geometry_msgs/PoseWithCovarianceStamped; the covariance row by row, ordered x, y, z, roll, pitch, yaw.
struct PoseMessage {
  std::int64_t stamp_ns = 0;
  std::string frame_id;
  Transform pose;
  std::array<double, 36> covariance{};
};

/// nav_msgs/OccupancyGrid.
struct GridMessage {
  std::string frame_id;
  double resolution_m = 0.0;
  std::uint32_t width_cells = 0;
  std::uint32_t height_cells = 0;
  Transform origin;  ///< of the outer corner of the first cell
  std::vector<std::int8_t> percent;
};

/// One transform for tf.
struct TransformMessage {
  std::int64_t stamp_ns = 0;
  std::string frame_id;
  std::string child_frame_id;
  Transform transform;
};

/// geometry_msgs/PoseArray and nav_msgs/Path.
struct PosesMessage {
  std::int64_t stamp_ns = 0;
  std::string frame_id;
  std::vector<Transform> poses;
};

/// visualization_msgs/Marker of points of one colour.
struct PointsMessage {
  std::int64_t stamp_ns = 0;
  std::string frame_id;
  std::string of_laser;  ///< the frame of its scans; those of several lasers stand side by side
  std::vector<std::array<double, 2>> points_m;
  std::array<float, 3> colour{};  ///< red, green, blue, 0 … 1
};

/// As in diagnostic_msgs/DiagnosticStatus.
enum class Level : unsigned char { ok = 0, warn = 1, error = 2 };

/// diagnostic_msgs/DiagnosticStatus.
struct DiagnosticMessage {
  Level level = Level::ok;
  std::string message;
  std::vector<std::pair<std::string, std::string>> values;
};

/// What a service answers.
struct Answer {
  bool is_done = false;
  std::string words;
};

}  // namespace beaconless::ros1
