// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"
#include "beaconless/io/frame_transform.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io {

/// Takes the primitives of a message one after the other: what ROS 1 and CDR write differently.
///
/// After the first that does not fit all are zero and ok() is false. `header_stamp` takes what a Header holds
/// before its frame, `at_end` says whether nothing is left.
template <class R>
concept PrimitiveReader = requires(R in, std::size_t count) {
  { in.template take<double>() } -> std::same_as<double>;
  { in.header_stamp() } -> std::same_as<Stamp>;
  { in.text() } -> std::same_as<std::string>;
  { in.floats() } -> std::same_as<std::vector<float>>;
  in.template skip<double>(count);
  { in.ok() } -> std::same_as<bool>;
  { in.at_end() } -> std::same_as<bool>;
};

/// The order of the fields in ROS messages, which is the same in ROS 1 and ROS 2.
///
/// Errors (without a place): the bytes end early or are too many, a pose is not finite.
namespace ros_layout {

constexpr std::size_t kCovariance_count = 36;

inline Error ends_early() { return {"", "the message is shorter or longer than its own lengths tell", ""}; }
inline Error no_pose() { return {"", "the pose is not finite or has no heading", ""}; }

/// A Pose or a Transform.
template <PrimitiveReader Reader>
void take_pose(Reader& in, FrameTransform& pose) {
  for (double* number : {&pose.translation_m.x(), &pose.translation_m.y(), &pose.translation_m.z(),
                         &pose.rotation.x(), &pose.rotation.y(), &pose.rotation.z(), &pose.rotation.w()})
    *number = in.template take<double>();
}

template <PrimitiveReader Reader>
Result<RawScan> take_laser_scan(Reader in) {
  RawScan scan;
  scan.stamp = in.header_stamp();
  scan.frame_id = in.text();
  scan.angle_min_rad = in.template take<float>();
  in.template skip<float>(1);  // angle_max: often off by one beam; the count of ranges decides
  scan.angle_increment_rad = in.template take<float>();
  scan.time_increment_s = in.template take<float>();
  scan.scan_time_s = in.template take<float>();
  scan.range_min_m = in.template take<float>();
  scan.range_max_m = in.template take<float>();
  scan.ranges_m = in.floats();
  scan.intensities = in.floats();
  if (!in.at_end()) return ends_early();
  return scan;
}

template <PrimitiveReader Reader>
Result<Odometry> take_odometry(Reader in) {
  Odometry odometry;
  odometry.stamp = in.header_stamp();
  in.text();  // frame
  in.text();  // child frame
  FrameTransform pose;
  take_pose(in, pose);
  in.template skip<double>(kCovariance_count);
  Twist2 twist;
  twist.x_m = in.template take<double>();
  twist.y_m = in.template take<double>();
  in.template skip<double>(3);
  twist.theta_rad = in.template take<double>();
  in.template skip<double>(kCovariance_count);
  if (!in.at_end()) return ends_early();
  odometry.odom_from_base = pose.planar();
  if (!odometry.odom_from_base.is_finite()) return no_pose();
  if (twist.vector().allFinite()) odometry.twist_per_s = twist;
  return odometry;
}

/// PoseStamped, or PoseWithCovarianceStamped with that many numbers after the pose.
template <PrimitiveReader Reader>
Result<ReferencePose> take_pose_stamped(Reader in, std::size_t covariance_count) {
  FrameTransform pose;
  pose.stamp = in.header_stamp();
  in.text();  // frame
  take_pose(in, pose);
  in.template skip<double>(covariance_count);
  if (!in.at_end()) return ends_early();
  const Pose2 planar = pose.planar();
  if (!planar.is_finite()) return no_pose();
  return ReferencePose{pose.stamp, planar, std::nullopt, ""};
}

template <PrimitiveReader Reader>
Result<std::vector<FrameTransform>> take_transforms(Reader in) {
  std::vector<FrameTransform> transforms;
  const auto count = in.template take<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    FrameTransform transform;
    transform.stamp = in.header_stamp();
    transform.parent = in.text();
    transform.child = in.text();
    take_pose(in, transform);
    if (in.ok()) transforms.push_back(std::move(transform));
  }
  if (!in.at_end()) return ends_early();
  return transforms;
}

}  // namespace ros_layout
}  // namespace beaconless::io
