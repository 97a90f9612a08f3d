// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/frame_transform.hpp"

#include <cmath>
#include <string_view>

#include "beaconless/io/quaternion_yaw.hpp"

namespace beaconless::io {
namespace {

bool is_odom_frame(std::string_view frame) {
  const std::size_t slash = frame.rfind('/');
  if (slash != std::string_view::npos) frame.remove_prefix(slash + 1);
  return frame == "odom" || frame.starts_with("odom_") || frame.ends_with("_odom");
}

/// Some trees hang the map below odom; such a transform is a localizer's answer, not dead reckoning.
bool is_map_frame(std::string_view frame) { return frame.find("map") != std::string_view::npos; }

}  // namespace

Pose2 FrameTransform::planar() const {
  const auto yaw = yaw_rad_of_quaternion(rotation.x(), rotation.y(), rotation.z(), rotation.w());
  return {translation_m.x(), translation_m.y(), yaw.value_or(std::nan(""))};
}

bool is_odom_transform(const FrameTransform& transform) {
  return is_odom_frame(transform.parent) && !is_map_frame(transform.child) && transform.planar().is_finite();
}

std::vector<Odometry> odometry_of(const std::vector<FrameTransform>& transforms) {
  std::vector<Odometry> found;
  for (const FrameTransform& transform : transforms)
    if (is_odom_transform(transform))
      found.push_back(
          {transform.stamp, transform.planar(), std::nullopt, transform.parent + "->" + transform.child});
  return found;
}

}  // namespace beaconless::io
