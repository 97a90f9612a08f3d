// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/ros_messages.hpp"

#include <algorithm>

namespace beaconless::ros1 {
namespace {

Transform plain(const geometry_msgs::Pose& pose) {
  return {pose.position.x,    pose.position.y,    pose.position.z,   pose.orientation.x,
          pose.orientation.y, pose.orientation.z, pose.orientation.w};
}

geometry_msgs::Pose ros_pose_of(const Transform& t) {
  geometry_msgs::Pose pose;
  pose.position.x = t.x_m, pose.position.y = t.y_m, pose.position.z = t.z_m;
  pose.orientation.x = t.qx, pose.orientation.y = t.qy, pose.orientation.z = t.qz, pose.orientation.w = t.qw;
  return pose;
}

template <class Message>
Message headed(std::int64_t stamp_ns, const std::string& frame_id) {
  Message message;
  message.header.stamp = ros_time(stamp_ns);
  message.header.frame_id = frame_id;
  return message;
}

std::int64_t ns_of(const ros::Time& time) { return static_cast<std::int64_t>(time.toNSec()); }

}  // namespace

ros::Time ros_time(std::int64_t stamp_ns) {
  ros::Time time;
  return time.fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(stamp_ns, 0)));
}

ScanMessage plain(const sensor_msgs::LaserScan& scan) {
  return {ns_of(scan.header.stamp), scan.header.frame_id, scan.angle_min,
          scan.angle_increment,     scan.time_increment,  scan.scan_time,
          scan.range_min,           scan.range_max,       scan.ranges,
          scan.intensities};
}

PoseMessage plain(const geometry_msgs::PoseWithCovarianceStamped& pose) {
  PoseMessage message{ns_of(pose.header.stamp), pose.header.frame_id, plain(pose.pose.pose), {}};
  std::copy(pose.pose.covariance.begin(), pose.pose.covariance.end(), message.covariance.begin());
  return message;
}

GridMessage plain(const nav_msgs::OccupancyGrid& grid) {
  return {grid.header.frame_id,    static_cast<double>(grid.info.resolution),
          grid.info.width,         grid.info.height,
          plain(grid.info.origin), grid.data};
}

Transform plain(const geometry_msgs::Transform& t) {
  return {t.translation.x, t.translation.y, t.translation.z, t.rotation.x,
          t.rotation.y,    t.rotation.z,    t.rotation.w};
}

TransformMessage plain(const geometry_msgs::TransformStamped& t) {
  return {ns_of(t.header.stamp), t.header.frame_id, t.child_frame_id, plain(t.transform)};
}

geometry_msgs::PoseWithCovarianceStamped ros_pose(const PoseMessage& pose) {
  auto message = headed<geometry_msgs::PoseWithCovarianceStamped>(pose.stamp_ns, pose.frame_id);
  message.pose.pose = ros_pose_of(pose.pose);
  std::copy(pose.covariance.begin(), pose.covariance.end(), message.pose.covariance.begin());
  return message;
}

geometry_msgs::TransformStamped ros_transform(const TransformMessage& transform) {
  auto message = headed<geometry_msgs::TransformStamped>(transform.stamp_ns, transform.frame_id);
  message.child_frame_id = transform.child_frame_id;
  const auto pose = ros_pose_of(transform.transform);
  message.transform.translation.x = pose.position.x;
  message.transform.translation.y = pose.position.y;
  message.transform.translation.z = pose.position.z;
  message.transform.rotation = pose.orientation;
  return message;
}

geometry_msgs::PoseArray ros_pose_array(const PosesMessage& poses) {
  auto message = headed<geometry_msgs::PoseArray>(poses.stamp_ns, poses.frame_id);
  for (const Transform& pose : poses.poses) message.poses.push_back(ros_pose_of(pose));
  return message;
}

nav_msgs::OccupancyGrid ros_grid(const GridMessage& grid) {
  nav_msgs::OccupancyGrid message;
  message.header.frame_id = grid.frame_id;
  message.header.stamp = message.info.map_load_time = ros::Time::now();
  message.info.resolution = static_cast<float>(grid.resolution_m);
  message.info.width = grid.width_cells;
  message.info.height = grid.height_cells;
  message.info.origin = ros_pose_of(grid.origin);
  message.data = grid.percent;
  return message;
}

nav_msgs::Path ros_path(const PosesMessage& poses) {
  auto message = headed<nav_msgs::Path>(poses.stamp_ns, poses.frame_id);
  for (const Transform& pose : poses.poses) {
    auto stamped = headed<geometry_msgs::PoseStamped>(poses.stamp_ns, poses.frame_id);
    stamped.pose = ros_pose_of(pose);
    message.poses.push_back(stamped);
  }
  return message;
}

visualization_msgs::Marker ros_points(const PointsMessage& points) {
  auto message = headed<visualization_msgs::Marker>(points.stamp_ns, points.frame_id);
  message.ns = points.of_laser;
  message.type = visualization_msgs::Marker::POINTS;
  message.action = visualization_msgs::Marker::ADD;
  message.pose.orientation.w = 1.0;
  message.scale.x = message.scale.y = 0.05;
  message.color.r = points.colour[0], message.color.g = points.colour[1], message.color.b = points.colour[2];
  message.color.a = 1.0F;
  message.points.resize(points.points_m.size());
  for (std::size_t i = 0; i < points.points_m.size(); ++i) {
    message.points[i].x = points.points_m[i][0];
    message.points[i].y = points.points_m[i][1];
  }
  return message;
}

}  // namespace beaconless::ros1
