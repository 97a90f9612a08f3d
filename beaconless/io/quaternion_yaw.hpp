// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

namespace beaconless::io {

/// The heading of a quaternion, whatever its length; nothing where it is zero or not finite.
inline std::optional<double> yaw_rad_of_quaternion(double x, double y, double z, double w) {
  const double length = std::hypot(std::hypot(x, y), std::hypot(z, w));
  if (!std::isfinite(length) || length < 1e-6) return std::nullopt;
  x /= length, y /= length, z /= length, w /= length;
  return std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
}

}  // namespace beaconless::io
