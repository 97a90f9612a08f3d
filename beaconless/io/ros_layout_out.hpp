// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "beaconless/event.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io {

/// Puts the primitives of a message one after the other: what ROS 1 and CDR write differently. The twin of
/// PrimitiveReader.
template <class W>
concept PrimitiveWriter = requires(W out, Stamp stamp, std::string_view text, std::span<const float> floats) {
  out.put(1.0);
  out.header_stamp(stamp);
  out.text(text);
  out.floats(floats);
  { out.take() } -> std::same_as<std::string>;
};

/// Seconds since 1970, rounded down, and the nanoseconds beyond them.
inline std::pair<std::int64_t, std::uint32_t> whole_seconds(Stamp stamp) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const std::int64_t nanos = ((stamp.ns % kSecond_ns) + kSecond_ns) % kSecond_ns;
  return {stamp.ns / kSecond_ns - (stamp.ns % kSecond_ns < 0 ? 1 : 0), static_cast<std::uint32_t>(nanos)};
}

/// The order of the fields in ROS messages, which is the same in ROS 1 and ROS 2. Poses lie in the plane.
namespace ros_layout {

template <PrimitiveWriter Writer>
void put_header(Writer& out, Stamp stamp, std::string_view frame) {
  out.header_stamp(stamp);
  out.text(frame);
}

/// A Pose or a Transform.
template <PrimitiveWriter Writer>
void put_pose(Writer& out, const Pose2& pose) {
  for (const double value :
       {pose.x_m, pose.y_m, 0.0, 0.0, 0.0, std::sin(pose.theta_rad / 2.0), std::cos(pose.theta_rad / 2.0)})
    out.put(value);
}

template <PrimitiveWriter Writer>
void put_no_covariance(Writer& out) {
  constexpr int kCount = 36;
  for (int i = 0; i < kCount; ++i) out.put(0.0);
}

template <PrimitiveWriter Writer>
std::string put_laser_scan(Writer out, const RawScan& scan) {
  put_header(out, scan.stamp, scan.frame_id);
  const auto steps = static_cast<float>(scan.ranges_m.empty() ? 0 : scan.ranges_m.size() - 1);
  out.put(scan.angle_min_rad);
  out.put(scan.angle_min_rad + steps * scan.angle_increment_rad);
  out.put(scan.angle_increment_rad);
  out.put(scan.time_increment_s);
  out.put(scan.scan_time_s);
  out.put(scan.range_min_m);
  out.put(scan.range_max_m);
  out.floats(scan.ranges_m);
  out.floats(scan.intensities);
  return out.take();
}

template <PrimitiveWriter Writer>
std::string put_odometry(Writer out, const Odometry& odometry, std::string_view frame,
                         std::string_view child_frame) {
  put_header(out, odometry.stamp, frame);
  out.text(child_frame);
  put_pose(out, odometry.odom_from_base);
  put_no_covariance(out);
  const Twist2 twist = odometry.twist_per_s.value_or(Twist2{});
  for (const double value : {twist.x_m, twist.y_m, 0.0, 0.0, 0.0, twist.theta_rad}) out.put(value);
  put_no_covariance(out);
  return out.take();
}

template <PrimitiveWriter Writer>
std::string put_pose_stamped(Writer out, Stamp stamp, std::string_view frame, const Pose2& pose) {
  put_header(out, stamp, frame);
  put_pose(out, pose);
  return out.take();
}

/// A TFMessage with one transform.
template <PrimitiveWriter Writer>
std::string put_transform(Writer out, Stamp stamp, std::string_view frame, std::string_view child_frame,
                          const Pose2& frame_from_child) {
  out.put(std::uint32_t{1});
  put_header(out, stamp, frame);
  out.text(child_frame);
  put_pose(out, frame_from_child);
  return out.take();
}

}  // namespace ros_layout
}  // namespace beaconless::io
