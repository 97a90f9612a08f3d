// SPDX-License-Identifier: Apache-2.0
#include "laser_words.hpp"

#include <fmt/format.h>

namespace beaconless::cli {

std::string laser_words(const io::LaserPlace& place) {
  const Pose2& at = place.base_from_laser;
  return fmt::format("{} says that the laser sits at {:.3f},{:.3f},{:.1f} on the robot", place.told_by,
                     at.x_m, at.y_m, degrees(at.theta_rad));
}

}  // namespace beaconless::cli
