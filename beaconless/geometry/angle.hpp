// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace beaconless {

inline constexpr double kPi = std::numbers::pi;

/// The same direction in [-pi, pi).
inline double wrap_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped >= kPi ? wrapped - 2.0 * kPi : wrapped;
}

constexpr double radians(double angle_deg) { return angle_deg * (kPi / 180.0); }
constexpr double degrees(double angle_rad) { return angle_rad * (180.0 / kPi); }

}  // namespace beaconless
