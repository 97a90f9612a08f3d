// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/cdr_encode.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "beaconless/io/cdr_writer.hpp"
#include "beaconless/io/float_text.hpp"

namespace beaconless::io {
namespace {

using Covariance = std::array<double, 36>;  // rows of x, y, z, roll, pitch, yaw

void put_stamp(CdrWriter& out, Stamp stamp) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  using Seconds = std::numeric_limits<std::int32_t>;
  const std::int64_t nanos = ((stamp.ns % kSecond_ns) + kSecond_ns) % kSecond_ns;
  const std::int64_t seconds = stamp.ns / kSecond_ns - (stamp.ns % kSecond_ns < 0 ? 1 : 0);
  out.put(static_cast<std::int32_t>(std::clamp<std::int64_t>(seconds, Seconds::min(), Seconds::max())));
  out.put(static_cast<std::uint32_t>(nanos));
}

void put_header(CdrWriter& out, Stamp stamp, std::string_view frame) {
  put_stamp(out, stamp);
  out.text(frame);
}

/// A pose or a transform.
void put_pose(CdrWriter& out, const Pose2& pose) {
  for (const double value :
       {pose.x_m, pose.y_m, 0.0, 0.0, 0.0, std::sin(pose.theta_rad / 2.0), std::cos(pose.theta_rad / 2.0)})
    out.put(value);
}

void put_covariance(CdrWriter& out, const Covariance& covariance) {
  for (const double value : covariance) out.put(value);
}

Covariance covariance_of(const Eigen::Matrix3d& planar) {
  constexpr std::array<std::size_t, 3> kPlace{0, 1, 5};
  Covariance covariance{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      covariance[6 * kPlace[row] + kPlace[column]] =
          planar(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
  return covariance;
}

/// DiagnosticStatus.level.
std::uint8_t level_of(Status status) {
  enum : std::uint8_t { ok, warn, error };
  if (status == Status::ok) return ok;
  return status == Status::lost || status == Status::not_started ? error : warn;
}

std::string text_of(double number) {
  std::string text;
  append_number(text, number);
  return text;
}

}  // namespace

std::string encode_laser_scan(const RawScan& scan) {
  CdrWriter out;
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

std::string encode_odometry(const Odometry& odometry, std::string_view frame, std::string_view child_frame) {
  CdrWriter out;
  put_header(out, odometry.stamp, frame);
  out.text(child_frame);
  put_pose(out, odometry.odom_from_base);
  put_covariance(out, {});
  const Twist2 twist = odometry.twist_per_s.value_or(Twist2{});
  for (const double value : {twist.x_m, twist.y_m, 0.0, 0.0, 0.0, twist.theta_rad}) out.put(value);
  put_covariance(out, {});
  return out.take();
}

std::string encode_pose_stamped(Stamp stamp, std::string_view frame, const Pose2& pose) {
  CdrWriter out;
  put_header(out, stamp, frame);
  put_pose(out, pose);
  return out.take();
}

std::string encode_pose_with_covariance_stamped(const PoseEstimate& estimate, std::string_view frame) {
  CdrWriter out;
  put_header(out, estimate.stamp, frame);
  put_pose(out, estimate.map_from_base);
  put_covariance(out, covariance_of(estimate.covariance));
  return out.take();
}

std::string encode_transform(Stamp stamp, std::string_view frame, std::string_view child_frame,
                             const Pose2& frame_from_child) {
  CdrWriter out;
  out.put(std::uint32_t{1});
  put_header(out, stamp, frame);
  out.text(child_frame);
  put_pose(out, frame_from_child);
  return out.take();
}

std::string encode_diagnostics(const PoseEstimate& estimate, std::string_view name) {
  const std::array<std::pair<std::string_view, std::string>, 6> values{
      {{"status", std::string(to_string(estimate.status))},
       {"reason", std::string(estimate.reason)},
       {"quality", text_of(estimate.quality)},
       {"protection_m", text_of(estimate.protection_m)},
       {"protection_rad", text_of(estimate.protection_rad)},
       {"jumped", estimate.jumped ? "true" : "false"}}};
  CdrWriter out;
  put_header(out, estimate.stamp, "");
  out.put(std::uint32_t{1});
  out.put(level_of(estimate.status));
  out.text(name);
  out.text(estimate.ok() ? to_string(estimate.status) : estimate.reason);
  out.text("");  // hardware
  out.put(static_cast<std::uint32_t>(values.size()));
  for (const auto& [key, value] : values) {
    out.text(key);
    out.text(value);
  }
  return out.take();
}

}  // namespace beaconless::io
