// SPDX-License-Identifier: Apache-2.0
#include "rosbag1_writer.hpp"

#include <cmath>
#include <stdexcept>

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

namespace beaconless {
namespace {

ros::Time ros_time(std::int64_t stamp_ns) {
  return {static_cast<std::uint32_t>(stamp_ns / 1'000'000'000),
          static_cast<std::uint32_t>(stamp_ns % 1'000'000'000)};
}

geometry_msgs::Quaternion quaternion(double theta_rad) {
  geometry_msgs::Quaternion q;
  q.z = std::sin(0.5 * theta_rad);
  q.w = std::cos(0.5 * theta_rad);
  return q;
}

geometry_msgs::Pose pose_of(const BagPose& from) {
  geometry_msgs::Pose pose;
  pose.position.x = from.x_m;
  pose.position.y = from.y_m;
  pose.orientation = quaternion(from.theta_rad);
  return pose;
}

sensor_msgs::LaserScan scan_of(const BagScan& from) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros_time(from.stamp_ns);
  scan.header.frame_id = from.frame_id;
  scan.angle_min = from.angle_min_rad;
  scan.angle_max = from.angle_min_rad + static_cast<float>(from.ranges_m.size()) * from.angle_increment_rad;
  scan.angle_increment = from.angle_increment_rad;
  scan.time_increment = from.time_increment_s;
  scan.scan_time = from.scan_time_s;
  scan.range_min = from.range_min_m;
  scan.range_max = from.range_max_m;
  scan.ranges = from.ranges_m;
  scan.intensities = from.intensities;
  return scan;
}

geometry_msgs::TransformStamped transform(const BagPose& from, const char* parent, const char* child) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros_time(from.stamp_ns);
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation.x = from.x_m;
  transform.transform.translation.y = from.y_m;
  transform.transform.rotation = quaternion(from.theta_rad);
  return transform;
}

}  // namespace

void write_bag(const std::string& path, const BagContent& content, BagCompression compression) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  bag.setCompression(compression == BagCompression::bz2   ? rosbag::compression::BZ2
                     : compression == BagCompression::lz4 ? rosbag::compression::LZ4
                                                          : rosbag::compression::Uncompressed);
  bag.setChunkThreshold(20'000);  // several chunks, also for little content
  for (const BagScan& scan : content.scans) bag.write("/scan", ros_time(scan.stamp_ns), scan_of(scan));
  for (const BagScan& scan : content.more_scans)
    bag.write("/rear/scan", ros_time(scan.stamp_ns), scan_of(scan));
  for (const BagPose& pose : content.odometry) {
    nav_msgs::Odometry odometry;
    odometry.header.stamp = ros_time(pose.stamp_ns);
    odometry.header.frame_id = "odom";
    odometry.child_frame_id = "base_link";
    odometry.pose.pose = pose_of(pose);
    odometry.twist.twist.linear.x = 1.0;
    odometry.twist.twist.linear.y = 2.0;
    odometry.twist.twist.angular.z = 3.0;
    bag.write("/odom", ros_time(pose.stamp_ns), odometry);
  }
  for (const BagPose& pose : content.transforms) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform(pose, "base_link", "laser"));
    message.transforms.push_back(transform(pose, "/odom", "base_link"));
    bag.write("/tf", ros_time(pose.stamp_ns), message);
  }
  for (const BagPose& pose : content.poses) {
    geometry_msgs::PoseStamped message;
    message.header.stamp = ros_time(pose.stamp_ns);
    message.pose = pose_of(pose);
    bag.write("/reference", ros_time(pose.stamp_ns), message);
  }
  for (const BagPose& pose : content.fixes) {
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header.stamp = ros_time(pose.stamp_ns);
    message.pose.pose = pose_of(pose);
    bag.write("/amcl_pose", ros_time(pose.stamp_ns), message);
  }
  for (const BagPose& pose : content.fixed) {
    BagPose half = pose;
    half.x_m /= 2;
    half.y_m /= 2;
    half.theta_rad = 0.0;
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform(half, "base_link", "shell"));
    bag.write("/tf_static", ros_time(pose.stamp_ns), message);
    half.theta_rad = pose.theta_rad;
    message.transforms.front() = transform(half, "shell", "base_laser_link");
    bag.write("/tf_static", ros_time(pose.stamp_ns), message);
  }
  bag.close();
}

namespace {

BagPose from_pose(const std_msgs::Header& header, const geometry_msgs::Pose& pose) {
  return {static_cast<std::int64_t>(header.stamp.toNSec()), pose.position.x, pose.position.y,
          2.0 * std::atan2(pose.orientation.z, pose.orientation.w)};
}

BagPose from_transform(const geometry_msgs::TransformStamped& from) {
  geometry_msgs::Pose pose;
  pose.position.x = from.transform.translation.x;
  pose.position.y = from.transform.translation.y;
  pose.orientation = from.transform.rotation;
  return from_pose(from.header, pose);
}

}  // namespace

BagContent read_bag(const std::string& path) {
  BagContent content;
  const rosbag::Bag bag(path);
  rosbag::View view(bag);
  for (const rosbag::MessageInstance& message : view) {
    if (const auto scan = message.instantiate<sensor_msgs::LaserScan>()) {
      content.scans.push_back({static_cast<std::int64_t>(scan->header.stamp.toNSec()), scan->header.frame_id,
                               scan->angle_min, scan->angle_increment, scan->time_increment, scan->scan_time,
                               scan->range_min, scan->range_max, scan->ranges, scan->intensities});
    } else if (const auto odometry = message.instantiate<nav_msgs::Odometry>()) {
      content.odometry.push_back(from_pose(odometry->header, odometry->pose.pose));
    } else if (const auto pose = message.instantiate<geometry_msgs::PoseStamped>()) {
      content.poses.push_back(from_pose(pose->header, pose->pose));
    } else if (const auto tf = message.instantiate<tf2_msgs::TFMessage>()) {
      const bool is_fixed = message.getTopic() == "/tf_static";
      (is_fixed ? content.fixed : content.transforms).push_back(from_transform(tf->transforms.at(0)));
      if (is_fixed) content.is_fixed_latched = message.isLatching();
    } else {
      throw std::runtime_error(message.getDataType() + " is not of the type that its MD5 sum says");
    }
  }
  return content;
}

}  // namespace beaconless
