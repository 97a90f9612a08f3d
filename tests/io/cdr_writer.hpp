// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "beaconless/event.hpp"
#include "beaconless/io/frame_transform.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless {

/// Writes CDR (version 1) as a middleware of ROS 2 does, in either byte order.
class CdrWriter {
 public:
  explicit CdrWriter(std::endian order = std::endian::little) : order_(order) {
    bytes_ = {0, static_cast<unsigned char>(order == std::endian::little ? 1 : 0), 0, 0};
  }

  template <class T>
  CdrWriter& put(T value) {
    while ((bytes_.size() - 4) % sizeof(T) != 0) bytes_.push_back(0);
    auto raw = std::bit_cast<std::array<unsigned char, sizeof(T)>>(value);
    if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
    return *this;
  }
  CdrWriter& text(const std::string& value) {
    put(static_cast<std::uint32_t>(value.size() + 1));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    bytes_.push_back(0);
    return *this;
  }
  CdrWriter& floats(const std::vector<float>& values) {
    put(static_cast<std::uint32_t>(values.size()));
    for (const float value : values) put(value);
    return *this;
  }
  CdrWriter& stamp(Stamp stamp) {
    constexpr std::int64_t kNanos = 1'000'000'000;
    return put(static_cast<std::int32_t>(stamp.ns / kNanos))
        .put(static_cast<std::uint32_t>(stamp.ns % kNanos));
  }
  CdrWriter& pose(const Eigen::Vector3d& at, const Eigen::Quaterniond& turn) {
    for (const double x : {at.x(), at.y(), at.z(), turn.x(), turn.y(), turn.z(), turn.w()}) put(x);
    return *this;
  }
  CdrWriter& pose(const Pose2& pose) {
    return this->pose({pose.x_m, pose.y_m, 0.0},
                      Eigen::Quaterniond(Eigen::AngleAxisd(pose.theta_rad, Eigen::Vector3d::UnitZ())));
  }
  CdrWriter& zeros(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) put(0.0);
    return *this;
  }
  const std::vector<unsigned char>& bytes() const { return bytes_; }

 private:
  std::endian order_;
  std::vector<unsigned char> bytes_;
};

using MessageBytes = std::vector<unsigned char>;

inline MessageBytes cdr_of(const RawScan& scan, std::endian order = std::endian::little) {
  return CdrWriter(order)
      .stamp(scan.stamp)
      .text(scan.frame_id)
      .put(scan.angle_min_rad)
      .put(0.0F)
      .put(scan.angle_increment_rad)
      .put(scan.time_increment_s)
      .put(scan.scan_time_s)
      .put(scan.range_min_m)
      .put(scan.range_max_m)
      .floats(scan.ranges_m)
      .floats(scan.intensities)
      .bytes();
}

inline MessageBytes cdr_of(const Odometry& odometry, std::endian order = std::endian::little) {
  const Twist2 twist = odometry.twist_per_s.value_or(Twist2{});
  return CdrWriter(order)
      .stamp(odometry.stamp)
      .text("odom")
      .text("base_link")
      .pose(odometry.odom_from_base)
      .zeros(36)
      .put(twist.x_m)
      .put(twist.y_m)
      .zeros(3)
      .put(twist.theta_rad)
      .zeros(36)
      .bytes();
}

/// PoseStamped, or with 36 numbers PoseWithCovarianceStamped.
inline MessageBytes cdr_of(const ReferencePose& pose, std::size_t covariance_count,
                           std::endian order = std::endian::little) {
  return CdrWriter(order)
      .stamp(pose.stamp)
      .text("map")
      .pose(pose.map_from_base)
      .zeros(covariance_count)
      .bytes();
}

inline MessageBytes cdr_of(const std::vector<io::FrameTransform>& transforms,
                           std::endian order = std::endian::little) {
  CdrWriter out(order);
  out.put(static_cast<std::uint32_t>(transforms.size()));
  for (const io::FrameTransform& transform : transforms)
    out.stamp(transform.stamp)
        .text(transform.parent)
        .text(transform.child)
        .pose(transform.translation_m, transform.rotation);
  return out.bytes();
}

}  // namespace beaconless
