// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// How far off a fit to the other face of a wall is: about as thick as walls are.
inline constexpr double kWallThickness_m = 0.12;

/// Poses beside one, all around at `step_m`, the heading kept.
///
/// A wall has two faces. A fit that starts more than half of its thickness off takes the far face for the
/// near one and stays there, though it explains far less; from one of these it gets out.
inline std::array<Pose2, 8> sidesteps(const Pose2& pose, double step_m = kWallThickness_m) {
  std::array<Pose2, 8> beside;
  for (std::size_t i = 0; i < beside.size(); ++i) {
    const double direction = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(beside.size());
    beside[i] = pose * Pose2{step_m * std::cos(direction), step_m * std::sin(direction), 0.0};
  }
  return beside;
}

}  // namespace beaconless
