// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/cdr_encode.hpp"

#include <array>
#include <utility>

#include "beaconless/io/cdr_writer.hpp"
#include "beaconless/io/float_text.hpp"
#include "beaconless/io/ros_layout_out.hpp"

namespace beaconless::io {
namespace {

using Covariance = std::array<double, 36>;  // rows of x, y, z, roll, pitch, yaw

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

std::string encode_laser_scan(const RawScan& scan) { return ros_layout::put_laser_scan(CdrWriter(), scan); }

std::string encode_odometry(const Odometry& odometry, std::string_view frame, std::string_view child_frame) {
  return ros_layout::put_odometry(CdrWriter(), odometry, frame, child_frame);
}

std::string encode_pose_stamped(Stamp stamp, std::string_view frame, const Pose2& pose) {
  return ros_layout::put_pose_stamped(CdrWriter(), stamp, frame, pose);
}

std::string encode_pose_with_covariance_stamped(const PoseEstimate& estimate, std::string_view frame) {
  CdrWriter out;
  ros_layout::put_header(out, estimate.stamp, frame);
  ros_layout::put_pose(out, estimate.map_from_base);
  for (const double value : covariance_of(estimate.covariance)) out.put(value);
  return out.take();
}

std::string encode_transform(Stamp stamp, std::string_view frame, std::string_view child_frame,
                             const Pose2& frame_from_child) {
  return ros_layout::put_transform(CdrWriter(), stamp, frame, child_frame, frame_from_child);
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
  ros_layout::put_header(out, estimate.stamp, "");
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
