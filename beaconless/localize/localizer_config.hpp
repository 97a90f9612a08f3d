// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/core/describe.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/localize/health.hpp"
#include "beaconless/match/icp.hpp"
#include "beaconless/match/local_search.hpp"
#include "beaconless/track/motion_filter.hpp"

namespace beaconless {

/// Everything that shapes a localizer.
struct LocalizerConfig {
  std::string method = "icp-full";
  Pose2 base_from_laser;  ///< where the laser sits on the robot
  IcpConfig icp;
  LocalSearchConfig search;
  MotionConfig motion;
  HealthConfig health;
};

void describe(Fields& fields, LocalizerConfig& config);

}  // namespace beaconless
