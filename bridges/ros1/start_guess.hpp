// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/localize/localizer.hpp"

#include "bridges/ros1/messages.hpp"

namespace beaconless::ros1 {

/// Where somebody thinks the robot is.
struct StartGuess {
  Pose2 map_from_base;
  std::optional<SearchRegion> within;  ///< where the guess is too wide to start at: look here
};

/// Judges a pose that came in from outside, as by /initialpose.
///
/// A guess good to 1 m and 45° (one sigma) is a pose to start at; a wider one, up to 100 m, a disc of three
/// sigmas to search, heading unknown. Errors: another frame, numbers that are not finite or no place on a
/// map, a quaternion of length zero, a covariance that is none or says nothing. Source: the failure of nav2's
/// amcl on a huge covariance (navigation2#5611).
Result<StartGuess> start_guess_of(const PoseMessage& pose, const std::string& global_frame);

}  // namespace beaconless::ros1
