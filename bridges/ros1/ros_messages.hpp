// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/LaserScan.h>
#include <visualization_msgs/Marker.h>

#include "bridges/ros1/messages.hpp"

// C++17: the headers that ROS generates cannot be read as C++20 (std::allocator<void>::rebind).
namespace beaconless::ros1 {

// Between messages of ROS and plain ones; every number as it is.

ScanMessage plain(const sensor_msgs::LaserScan& scan);
PoseMessage plain(const geometry_msgs::PoseWithCovarianceStamped& pose);
GridMessage plain(const nav_msgs::OccupancyGrid& grid);
Transform plain(const geometry_msgs::Transform& transform);
TransformMessage plain(const geometry_msgs::TransformStamped& transform);

geometry_msgs::PoseWithCovarianceStamped ros_pose(const PoseMessage& pose);
geometry_msgs::TransformStamped ros_transform(const TransformMessage& transform);
geometry_msgs::PoseArray ros_pose_array(const PosesMessage& poses);
nav_msgs::OccupancyGrid ros_grid(const GridMessage& grid);
nav_msgs::Path ros_path(const PosesMessage& poses);
visualization_msgs::Marker ros_points(const PointsMessage& points);

/// A stamp of ROS; before 1970 is 0.
ros::Time ros_time(std::int64_t stamp_ns);

}  // namespace beaconless::ros1
